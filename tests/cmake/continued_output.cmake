# cmake -D PROGRAMS=a|b -D FILE=name -P continued_output.cmake -- mpiexec -n
#
# Fails unless a run of 40 steps on 3 ranks that the programs continue in turn from a file ends with the same file and
# output as one without a stop; or if 2 ranks that continue it do not use its costs, or miss pairs of neighbours.
include(${CMAKE_CURRENT_LIST_DIR}/command_after_dashes.cmake)
string(REPLACE "|" ";" programs "${PROGRAMS}")

function(run program ranks steps file)
  separate_arguments(program)
  execute_process(COMMAND ${command} ${ranks} ${RRCB_MPIEXEC_FLAGS} ${program} ${steps} ${file}
                  OUTPUT_VARIABLE output ERROR_VARIABLE errors RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${program}: exit code ${result}\n${output}${errors}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE ${FILE} ${FILE}.whole)
list(GET programs 0 first)
run("${first}" 3 40 ${FILE}.whole)
set(whole "${output}")
list(LENGTH programs num_programs)
set(number 0)
foreach(program IN LISTS programs)
  math(EXPR number "${number} + 1")
  math(EXPR steps "40 * ${number} / ${num_programs}")
  run("${program}" 3 ${steps} ${FILE})
endforeach()
string(REGEX REPLACE "^continued at step [^\n]+\n" "" rest "${output}")
file(SHA256 ${FILE} hash)
file(SHA256 ${FILE}.whole hash_of_whole)
if(NOT rest STREQUAL whole OR NOT hash STREQUAL hash_of_whole)
  message(FATAL_ERROR "not as without a stop, ${hash_of_whole}:\n${whole}but ${hash}:\n${output}")
endif()

run("${first}" 3 41 ${FILE}.whole)
string(REGEX MATCH "[0-9]+ pairs" pairs "${output}")
run("${first}" 2 41 ${FILE})
if(NOT output MATCHES "continued at step 40: learned costs are used.*loaded from 3 ranks" OR NOT output MATCHES "\n${pairs} ")
  message(FATAL_ERROR "2 ranks do not go on as 3, with ${pairs} of neighbours:\n${output}")
endif()
