# Sweeps with COMMAND into FOLDER, which must give ROWS rows without a failure in sweep.csv; a second
# run measures nothing again, and a third only the row that was cut short.
function(sweep)
  execute_process(COMMAND ${COMMAND} --out=${FOLDER} RESULT_VARIABLE code OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "exit code ${code}:\n${output}")
  endif()
endfunction()

function(read_rows result)
  file(READ ${FOLDER}/sweep.csv text)
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

function(expect_rows text)
  string(REGEX MATCHALL "[^\n]+,\n" rows "${text}")
  list(LENGTH rows count)
  if(NOT count EQUAL ROWS)
    message(FATAL_ERROR "${count} complete rows in sweep.csv instead of ${ROWS}:\n${text}")
  endif()
endfunction()

file(REMOVE_RECURSE ${FOLDER})
sweep()
read_rows(first)
expect_rows("${first}")

sweep()
read_rows(second)
if(NOT second STREQUAL first)
  message(FATAL_ERROR "a second run measured again:\n${second}\nafter\n${first}")
endif()

string(REGEX REPLACE "[0-9.]+,\n$" "" cut "${first}")
file(WRITE ${FOLDER}/sweep.csv "${cut}")
sweep()
read_rows(third)
expect_rows("${third}")
string(REGEX REPLACE "[^\n]+\n$" "" kept "${first}")
string(FIND "${third}" "${kept}" position)
if(NOT position EQUAL 0)
  message(FATAL_ERROR "a third run changed complete rows:\n${third}\nafter\n${first}")
endif()
