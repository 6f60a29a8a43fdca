# Runs COMMAND, whose only method is dumped to FOLDER by the environment, and then REPLAY of the
# first dump: both tables must hold the same imbalance and moved fraction.
cmake_minimum_required(VERSION 3.22)
file(REMOVE_RECURSE ${FOLDER})
set(ENV{RRCB_DUMP} ${FOLDER}/dumps)
set(ENV{RRCB_DUMP_WHEN} ALWAYS)
execute_process(COMMAND ${COMMAND} --out=${FOLDER}/original COMMAND_ERROR_IS_FATAL ANY
                OUTPUT_QUIET)
unset(ENV{RRCB_DUMP})
execute_process(
  COMMAND ${REPLAY} --replay=${FOLDER}/dumps/call-1 --out=${FOLDER}/replay COMMAND_ERROR_IS_FATAL
          ANY
  OUTPUT_VARIABLE output)
if(NOT output MATCHES "dump: Zoltan_LB_Partition on [0-9]+ ranks, code 0, parameters: ")
  message(FATAL_ERROR "the replay does not tell what it replays:\n${output}")
endif()
foreach(run IN ITEMS original replay)
  file(STRINGS ${FOLDER}/${run}/table.csv row REGEX "^rrcb,")
  string(REPLACE "," ";" fields "${row}")
  list(GET fields 12 ${run}_imbalance)
  list(GET fields 17 ${run}_moved)
endforeach()
if(NOT original_imbalance STREQUAL replay_imbalance OR NOT original_moved STREQUAL replay_moved
   OR original_imbalance STREQUAL "")
  message(FATAL_ERROR "imbalance ${original_imbalance}, moved ${original_moved}, but replayed "
                      "${replay_imbalance} and ${replay_moved}")
endif()
