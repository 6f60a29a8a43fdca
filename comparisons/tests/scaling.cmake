# Counts the calls of RRCB on 2, 9 and 43 ranks, the least that need a second message
# for their cuts, with DRIVER into FOLDER; MODEL must predict all of them.
file(REMOVE_RECURSE ${FOLDER})
foreach(ranks 2 9 43)
  execute_process(
    COMMAND
      ${MPIEXEC} ${ranks} ${DRIVER} --out=${FOLDER}/ranks-${ranks} --cloud=uniform
      --layout=scattered --points=12000 --repeats=1
      "--methods=rrcb[mesh=4,refine=none],rrcb[mesh=4,tol=2],rrcb-exact[mesh=4]"
    RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ranks} ranks: exit code ${code}:\n${output}")
  endif()
endforeach()
find_program(python3 NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(python3 NAMES python3)
execute_process(COMMAND ${python3} ${MODEL} ${FOLDER} RESULT_VARIABLE code OUTPUT_VARIABLE output
                                                                       ERROR_VARIABLE output)
if(NOT code EQUAL 0 OR NOT output MATCHES "Counts of 9 calls checked, 0 differ")
  message(FATAL_ERROR "exit code ${code}:\n${output}")
endif()
