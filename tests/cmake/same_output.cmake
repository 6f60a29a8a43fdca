# cmake -D PROGRAMS=a;b -P same_output.cmake -- command ...
#
# Fails unless the command with each program at its end exits with 0 and prints the same.
include(${CMAKE_CURRENT_LIST_DIR}/command_after_dashes.cmake)
foreach(program IN LISTS PROGRAMS)
  execute_process(COMMAND ${command} ${program} OUTPUT_VARIABLE output RESULT_VARIABLE result)
  if(NOT DEFINED expected)
    set(expected "${output}")
  endif()
  if(NOT result EQUAL 0 OR output STREQUAL "" OR NOT output STREQUAL expected)
    message(FATAL_ERROR "${program}: exit code ${result}, output\n${output}\nin place of\n${expected}")
  endif()
endforeach()
