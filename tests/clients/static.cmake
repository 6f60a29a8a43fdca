# Zoltan as a static archive: the tests of the plug-in, compiled through the renaming header.
if(NOT CMAKE_C_COMPILER_ID STREQUAL "GNU")
  rrcb_left_out("test of a static Zoltan" "its archive needs gcc")
  return()
endif()

file(REAL_PATH ${RRCB_ZOLTAN_LIBRARY} zoltan_library)
execute_process(COMMAND ${CMAKE_NM} --dynamic --defined-only ${zoltan_library}
                OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL " T Zoltan_[A-Za-z0-9_]+" functions "${symbols}")
list(TRANSFORM functions REPLACE " T (.*)" "FORWARD(\\1)\n")
list(JOIN functions "" functions)
file(CONFIGURE OUTPUT zoltan_functions.h CONTENT "${functions}")

# Hundreds of functions that only hand on: optimised, they take five times as long to compile.
set_source_files_properties(zoltan_archive.c PROPERTIES COMPILE_OPTIONS -O0)
add_library(zoltan_archive STATIC zoltan_archive.c)
target_include_directories(zoltan_archive PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
target_compile_definitions(zoltan_archive PRIVATE ZOLTAN_LIBRARY="${zoltan_library}")
target_link_libraries(zoltan_archive PRIVATE ${CMAKE_DL_LIBS})

function(add_static_test name archive)
  rrcb_add_test(
    NAME clients.${name}
    SOURCES static_test.cpp ../zoltan/program.cpp ${ARGN}
    LIBRARIES rrcb::zoltan_static ${archive}
    RANKS 1 2 4
    LABELS clients)
  target_compile_options(clients.${name} PRIVATE -include rrcb/zoltan/rrcb_zoltan_rename.h)
  target_include_directories(clients.${name} PRIVATE ../zoltan)
  target_include_directories(
    clients.${name} SYSTEM PRIVATE $<TARGET_PROPERTY:Zoltan::zoltan,INTERFACE_INCLUDE_DIRECTORIES>)
endfunction()
add_static_test(static zoltan_archive ../zoltan/lists_test.cpp ../zoltan/lookups_test.cpp
                ../zoltan/serialization_test.cpp)

# A program of a static Zoltan that nothing was compiled into cannot be reached.
if(can_preload)
  add_executable(static_client static_client.c)
  target_include_directories(
    static_client SYSTEM PRIVATE $<TARGET_PROPERTY:Zoltan::zoltan,INTERFACE_INCLUDE_DIRECTORIES>)
  target_link_libraries(static_client PRIVATE zoltan_archive MPI::MPI_C)
  add_client_run(static.preloaded ${preloaded} -x RRCB_REPLACE=RCB $<TARGET_FILE:static_client>)
  expect_exit_notice(static.preloaded)
  # Neither asked nor, in a shell around the program, in the way.
  add_client_run(static.preloaded.unasked ${preloaded} $<TARGET_FILE:static_client>)
  add_client_run(static.preloaded.shell ${preloaded} -x RRCB_REPLACE=RCB sh -c true)
  set_tests_properties(
    clients.static.preloaded.unasked.np4 clients.static.preloaded.shell.np4
    PROPERTIES FAIL_REGULAR_EXPRESSION "RRCB")
endif()
