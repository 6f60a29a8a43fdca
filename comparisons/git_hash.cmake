# Writes OUTPUT, a header with the commit of SOURCE_DIR, when it has changed.
execute_process(
  COMMAND git -C ${SOURCE_DIR} describe --always --dirty --abbrev=12
  OUTPUT_VARIABLE hash
  OUTPUT_STRIP_TRAILING_WHITESPACE
  ERROR_QUIET)
if(NOT hash)
  set(hash "commit unknown")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT [[
#pragma once

namespace comparisons {
inline constexpr const char* git_hash = "@hash@";
}
]] @ONLY)
