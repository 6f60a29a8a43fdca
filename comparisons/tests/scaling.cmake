# Counts with DRIVER into FOLDER the calls of RRCB on 2, 9 and 43 ranks, the least that need a second
# message for their cuts, and of Zoltan's RCB on the first two; MODEL must predict all of them.
cmake_minimum_required(VERSION 3.22)
file(REMOVE_RECURSE ${FOLDER})
set(methods "rrcb[mesh=4,refine=none],rrcb[mesh=4,tol=2],rrcb[mesh=4],rrcb-exact[mesh=4]")
string(APPEND methods ",rrcb-arrays[mesh=4,tol=2,central=2],rrcb-arrays[mesh=4,refine=exact,central=2]")
string(APPEND methods ",rrcb[mesh=4,tol=2,central=2]")
foreach(run IN ITEMS "2 ,zoltan-rcb" "9 ,zoltan-rcb" "43 ")
  string(REGEX MATCH "^([0-9]+) (.*)$" run "${run}")
  set(ranks ${CMAKE_MATCH_1})
  execute_process(
    COMMAND ${MPIEXEC} ${ranks} ${DRIVER} --out=${FOLDER}/ranks-${ranks} --cloud=uniform
            --layout=scattered --points=12000 --repeats=1 "--methods=${methods}${CMAKE_MATCH_2}"
    RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ranks} ranks: exit code ${code}:\n${output}")
  endif()
endforeach()
find_program(python3 NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
find_program(python3 NAMES python3)
execute_process(COMMAND ${python3} ${MODEL} ${FOLDER} RESULT_VARIABLE code OUTPUT_VARIABLE output
                                                                       ERROR_VARIABLE output)
if(NOT code EQUAL 0 OR NOT output MATCHES "Counts of 20 calls checked, 0 differ")
  message(FATAL_ERROR "exit code ${code}:\n${output}")
endif()
