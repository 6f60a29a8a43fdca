# rrcb_set_test_options(target)
#
# Warnings, except of unused results, of calls that must fail. Compiled quickly, with headers read once for
# all tests: most of a test is set-up.
# At -O1 GCC 12 takes sums of short strings to write past their ends. Pointers of tests are checked by the
# address sanitizer only: UBSan's checks of them double the time to compile.
function(rrcb_set_test_options target)
  rrcb_set_warnings(${target})
  target_compile_options(
    ${target}
    PRIVATE -Wno-unused-result $<$<CONFIG:Release>:-O1>
            $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU>>:-Wno-array-bounds -Wno-restrict
            -Wno-stringop-overflow>)
  if(CMAKE_CXX_FLAGS MATCHES "-fsanitize=address,undefined")
    target_compile_options(${target} PRIVATE -fno-sanitize=null,alignment,object-size,vptr)
  endif()
  if(TARGET rrcb_mpi_test_main AND NOT target STREQUAL rrcb_mpi_test_main)
    target_precompile_headers(${target} REUSE_FROM rrcb_mpi_test_main)
  endif()
endfunction()

# rrcb_choose_mpiexec_flags(result)
#
# What the launcher needs to start more ranks than there are cores. Ranks that spin while they wait
# would wait long for each other on a busy machine.
function(rrcb_choose_mpiexec_flags result)
  execute_process(COMMAND ${MPIEXEC_EXECUTABLE} --version OUTPUT_VARIABLE version ERROR_QUIET)
  set(flags)
  if(version MATCHES "Open MPI|OpenRTE|PRRTE")
    set(flags --oversubscribe --allow-run-as-root --bind-to none --mca mpi_yield_when_idle 1)
  elseif(version MATCHES "HYDRA" AND RRCB_TESTS)
    set(flags -genv LD_PRELOAD ${PROJECT_BINARY_DIR}/tests/librrcb_yielding.so)
  endif()
  set(${result} "${flags}" PARENT_SCOPE)
endfunction()
rrcb_choose_mpiexec_flags(flags)
set(RRCB_MPIEXEC_FLAGS "${flags}" CACHE STRING "Flags for mpiexec, as the MPI at hand needs them")

# rrcb_limit(<result> <seconds>)
#
# The time limit of tests that take at most so long on a quiet machine. It ends hangs only, so it is five
# times as long.
function(rrcb_limit result seconds)
  math(EXPR limit "5 * ${seconds}")
  set(${result} ${limit} PARENT_SCOPE)
endfunction()

# rrcb_set_tests_properties(tests... PROPERTIES [name value...] TIMEOUT seconds [name value...])
#
# As set_tests_properties, with the limit of rrcb_limit. No value is empty.
function(rrcb_set_tests_properties)
  cmake_parse_arguments(PARSE_ARGV 0 ARG "" "TIMEOUT" "")
  rrcb_limit(limit ${ARG_TIMEOUT})
  set_tests_properties(${ARG_UNPARSED_ARGUMENTS} TIMEOUT ${limit})
endfunction()

# rrcb_add_test(NAME name SOURCES files... [LIBRARIES targets...] [RANKS counts...] [LABELS ...]
#               [TIMEOUT seconds] [ENVIRONMENT variable=value ...])
#
# A GoogleTest program; with RANKS it runs once under mpirun for every rank count, and links the
# main function that initialises MPI and fails on all ranks when it fails on one.
function(rrcb_add_mpi_run)
  cmake_parse_arguments(ARG "" "NAME;RANKS;TIMEOUT" "COMMAND;LABELS;ENVIRONMENT" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 60)
  endif()
  rrcb_limit(limit ${ARG_TIMEOUT})
  add_test(NAME ${ARG_NAME} COMMAND ${MPIEXEC_EXECUTABLE} ${MPIEXEC_NUMPROC_FLAG} ${ARG_RANKS}
                                    ${RRCB_MPIEXEC_FLAGS} ${ARG_COMMAND})
  set_tests_properties(
    ${ARG_NAME} PROPERTIES TIMEOUT ${limit} PROCESSORS ${ARG_RANKS} LABELS "${ARG_LABELS}"
                           ENVIRONMENT "${ARG_ENVIRONMENT}")
endfunction()

function(rrcb_add_test)
  cmake_parse_arguments(ARG "" "NAME;TIMEOUT" "SOURCES;LIBRARIES;RANKS;LABELS;ENVIRONMENT" ${ARGN})
  add_executable(${ARG_NAME} ${ARG_SOURCES})
  rrcb_set_test_options(${ARG_NAME})
  target_link_libraries(${ARG_NAME} PRIVATE ${ARG_LIBRARIES})
  # Allocations are traced by frame pointers, in a tenth of the time that tables of unwinding take.
  list(APPEND ARG_ENVIRONMENT "ASAN_OPTIONS=fast_unwind_on_malloc=1:intercept_tls_get_addr=0")
  if(ARG_RANKS)
    target_link_libraries(${ARG_NAME} PRIVATE rrcb_mpi_test_main)
    # Only calls of the library keep floating-point exceptions to themselves.
    if(NOT ARG_LABELS MATCHES "^(mpi|zoltan|hard|properties|faults)$")
      list(APPEND ARG_ENVIRONMENT RRCB_TEST_TRAPS=OFF)
    endif()
    foreach(ranks IN LISTS ARG_RANKS)
      rrcb_add_mpi_run(NAME ${ARG_NAME}.np${ranks} RANKS ${ranks} COMMAND $<TARGET_FILE:${ARG_NAME}>
                       LABELS ${ARG_LABELS} TIMEOUT ${ARG_TIMEOUT} ENVIRONMENT ${ARG_ENVIRONMENT})
    endforeach()
  else()
    target_link_libraries(${ARG_NAME} PRIVATE GTest::gtest_main)
    add_test(NAME ${ARG_NAME} COMMAND ${ARG_NAME})
    rrcb_set_tests_properties(${ARG_NAME} PROPERTIES TIMEOUT 60 LABELS "${ARG_LABELS}"
                                                     ENVIRONMENT "${ARG_ENVIRONMENT}")
  endif()
endfunction()

# rrcb_add_example_test(NAME name RANKS count SOURCE file COMMAND command ...)
#
# Runs an example under mpirun; its output must be the one in the comment at the end of SOURCE.
function(rrcb_add_example_test)
  cmake_parse_arguments(ARG "" "NAME;RANKS;SOURCE" "COMMAND" ${ARGN})
  add_test(
    NAME ${ARG_NAME}
    COMMAND
      ${CMAKE_COMMAND} -D SOURCE=${CMAKE_CURRENT_SOURCE_DIR}/${ARG_SOURCE} -P
      ${PROJECT_SOURCE_DIR}/tests/cmake/check_output.cmake -- ${MPIEXEC_EXECUTABLE}
      ${MPIEXEC_NUMPROC_FLAG} ${ARG_RANKS} ${RRCB_MPIEXEC_FLAGS} ${ARG_COMMAND})
  rrcb_set_tests_properties(${ARG_NAME} PROPERTIES TIMEOUT 60 PROCESSORS ${ARG_RANKS} LABELS examples)
endfunction()
