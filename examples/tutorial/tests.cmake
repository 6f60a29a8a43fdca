# Each step of the tutorial prints what the end of its source says, in C++ and in Python.

# add_steps(<prefix of names> <ending of sources> <environment> <command with STEP for the number...>)
function(add_steps prefix ending environment)
  foreach(number RANGE 1 5)
    string(REPLACE STEP ${number} command "${ARGN}")
    set(ranks 4)
    if(number EQUAL 1)
      set(ranks 1)
    endif()
    rrcb_add_example_test(NAME ${prefix}.step${number} RANKS ${ranks}
                          SOURCE tutorial/step${number}.${ending} COMMAND ${command})
    set_tests_properties(${prefix}.step${number} PROPERTIES ENVIRONMENT "${environment}")
  endforeach()
  # A run on 4 ranks, which one on 3 continues.
  string(REPLACE STEP 6 command "${ARGN}")
  set(file ${CMAKE_CURRENT_BINARY_DIR}/tutorial/${prefix}.npz)
  add_test(NAME ${prefix}.step6.clean COMMAND ${CMAKE_COMMAND} -E rm -f ${file})
  rrcb_add_mpi_run(NAME ${prefix}.step6.begin RANKS 4 LABELS examples ENVIRONMENT ${environment}
                   COMMAND ${command} ${file})
  rrcb_add_example_test(NAME ${prefix}.step6 RANKS 3 SOURCE tutorial/step6.${ending}
                        COMMAND ${command} ${file})
  rrcb_set_tests_properties(${prefix}.step6.clean PROPERTIES LABELS examples TIMEOUT 60
                                                             FIXTURES_SETUP ${prefix}.clean)
  set_tests_properties(${prefix}.step6.begin PROPERTIES FIXTURES_REQUIRED ${prefix}.clean
                                                        FIXTURES_SETUP ${prefix}.begun)
  set_tests_properties(${prefix}.step6 PROPERTIES FIXTURES_REQUIRED ${prefix}.begun
                                                  ENVIRONMENT "${environment}")
endfunction()

add_steps(tutorial cpp "" ${CMAKE_CURRENT_BINARY_DIR}/tutorial/stepSTEP)
if(RRCB_PYTHON)
  add_steps(python.tutorial py
            "RRCB_LIBRARY=$<TARGET_FILE:rrcb_shared>;PYTHONPATH=${PROJECT_SOURCE_DIR}/python"
            ${RRCB_PYTHON} -B ${CMAKE_CURRENT_SOURCE_DIR}/tutorial/stepSTEP.py)
endif()
