# Warnings for the project's own code; private, so that users of the library never see them.
function(rrcb_set_warnings target)
  target_compile_options(
    ${target} PRIVATE $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wconversion
                      -Wno-sign-conversion> $<$<BOOL:${RRCB_WERROR}>:-Werror>)
endfunction()
