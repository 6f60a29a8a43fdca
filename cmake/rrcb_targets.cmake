# Warnings for the project's own code; private, so that users of the library never see them. Pragmas
# for GCC are nothing to Clang.
function(rrcb_set_warnings target)
  target_compile_options(
    ${target}
    PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wconversion
            -Wno-sign-conversion> $<$<CXX_COMPILER_ID:Clang>:-Wno-unknown-pragmas>
            $<$<BOOL:${RRCB_WERROR}>:-Werror>)
endfunction()

# Compiles the headers that nearly every file includes once for a target.
function(rrcb_precompile target)
  target_precompile_headers(
    ${target} PRIVATE <mpi.h> <algorithm> <array> <cmath> <functional> <map> <optional> <span>
    <string> <vector> ${ARGN})
endfunction()

# rrcb_compile_together(<target> <file that is compiled alone...>)
#
# Compiles the files of a target in groups, which takes less time from scratch.
function(rrcb_compile_together target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

function(rrcb_set_soname target)
  set_target_properties(${target} PROPERTIES VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR})
endfunction()

# Leaves a shared library no symbols but those of a version script; the compiler's own for
# templates of the standard library would show otherwise.
function(rrcb_show_only target map)
  target_link_options(${target} PRIVATE LINKER:--version-script=${map})
  set_property(TARGET ${target} APPEND PROPERTY LINK_DEPENDS ${map})
endfunction()
