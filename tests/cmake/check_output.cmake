# cmake -D SOURCE=main.cpp -P check_output.cmake -- command ...
#
# Fails unless the command ends with 0 and prints what the comment at the end of SOURCE says: the
# lines after the one that reads "// Output ...:", "! Output ...:" in Fortran or "# Output ...:" in Python.
file(STRINGS ${SOURCE} lines REGEX "^(//|!|#)")
set(expected "")
set(inside FALSE)
foreach(line IN LISTS lines)
  if(inside)
    string(REGEX REPLACE "^(//|!|#) *" "" line "${line}")
    string(APPEND expected "${line}\n")
  elseif(line MATCHES "^(//|!|#) Output .*:$")
    set(inside TRUE)
  endif()
endforeach()

include(${CMAKE_CURRENT_LIST_DIR}/command_after_dashes.cmake)

execute_process(COMMAND ${command} OUTPUT_VARIABLE output RESULT_VARIABLE result)
if(NOT result EQUAL 0 OR NOT output STREQUAL expected)
  message(FATAL_ERROR "exit code ${result}, output\n${output}\nbut ${SOURCE} promises\n${expected}")
endif()
