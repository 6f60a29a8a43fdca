# Runs COMMAND with ARGUMENTS, its only method dumped to FOLDER by the environment, and then on the
# first dump: both tables must hold the same imbalance and moved fraction.
cmake_minimum_required(VERSION 3.22)
separate_arguments(ARGUMENTS)
file(REMOVE_RECURSE ${FOLDER})
set(ENV{RRCB_DUMP} ${FOLDER}/dumps)
set(ENV{RRCB_DUMP_WHEN} ALWAYS)
execute_process(COMMAND ${COMMAND} ${ARGUMENTS} --out=${FOLDER}/original COMMAND_ERROR_IS_FATAL ANY
                OUTPUT_QUIET)
unset(ENV{RRCB_DUMP})
execute_process(
  COMMAND ${COMMAND} --replay=${FOLDER}/dumps/call-1 --out=${FOLDER}/replay COMMAND_ERROR_IS_FATAL
          ANY
  OUTPUT_VARIABLE output)
if(NOT output MATCHES "dump: Zoltan_LB_Partition on [0-9]+ ranks, code 0, parameters: ")
  message(FATAL_ERROR "the replay does not tell what it replays:\n${output}")
endif()
foreach(run IN ITEMS original replay)
  file(STRINGS ${FOLDER}/${run}/table.csv rows REGEX "^(method|rrcb),")
  list(GET rows 0 columns)
  list(GET rows 1 fields)
  string(REPLACE "," ";" columns "${columns}")
  string(REPLACE "," ";" fields "${fields}")
  foreach(column IN ITEMS imbalance moved_fraction)
    list(FIND columns ${column} at)
    list(GET fields ${at} ${run}_${column})
  endforeach()
endforeach()
if(NOT original_imbalance STREQUAL replay_imbalance OR original_imbalance STREQUAL ""
   OR NOT original_moved_fraction STREQUAL replay_moved_fraction)
  message(FATAL_ERROR "imbalance ${original_imbalance}, moved ${original_moved_fraction}, but "
                      "replayed ${replay_imbalance} and ${replay_moved_fraction}")
endif()
