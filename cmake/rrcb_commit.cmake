# RRCB_COMMIT, which the library reports: an archive made by git has it here, a clone has it in its HEAD. A copy
# inside another repository has none.
set(RRCB_COMMIT "$Format:%H$")
if(RRCB_COMMIT MATCHES "Format")
  execute_process(
    COMMAND git -C ${CMAKE_CURRENT_LIST_DIR} rev-parse --show-prefix HEAD
    OUTPUT_VARIABLE RRCB_COMMIT
    OUTPUT_STRIP_TRAILING_WHITESPACE
    ERROR_QUIET)
  if(RRCB_COMMIT MATCHES "^cmake/\n([0-9a-f]+)$")
    set(RRCB_COMMIT ${CMAKE_MATCH_1})
  else()
    set(RRCB_COMMIT "")
  endif()
endif()
if(RRCB_COMMIT)
  string(SUBSTRING ${RRCB_COMMIT} 0 12 RRCB_COMMIT)
else()
  set(RRCB_COMMIT unknown)
endif()
