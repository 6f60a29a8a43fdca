# cmake -D OUTPUT=regex [-D FAILS=TRUE] -P expect.cmake -- command ...
#
# Fails unless the command prints what matches, and ends with 0, or with FAILS with another code.
include(${CMAKE_CURRENT_LIST_DIR}/command_after_dashes.cmake)

execute_process(COMMAND ${command} OUTPUT_VARIABLE output ERROR_VARIABLE output
                RESULT_VARIABLE result)
if(result EQUAL 0)
  set(failed FALSE)
else()
  set(failed TRUE)
endif()
if((FAILS AND NOT failed) OR (failed AND NOT FAILS) OR NOT output MATCHES "${OUTPUT}")
  message(FATAL_ERROR "exit code ${result}, and output that should match \"${OUTPUT}\":\n${output}")
endif()
