# Other builds of Zoltan than Debian's, behind the plug-in.

# Functions of Zoltan from two libraries: the plug-in names them and leaves all to Zoltan, which
# knows no RRCB.
add_library(stray_zoltan SHARED stray_zoltan.c)
add_executable(two_zoltans_client ${PROJECT_SOURCE_DIR}/examples/zoltan_drop_in/main.c)
target_link_options(two_zoltans_client PRIVATE LINKER:--no-as-needed)
target_link_libraries(two_zoltans_client PRIVATE rrcb::zoltan stray_zoltan Zoltan::zoltan)
add_client_run(two_zoltans $<TARGET_FILE:two_zoltans_client>)
set_tests_properties(
  clients.two_zoltans.np4
  PROPERTIES
    PASS_REGULAR_EXPRESSION
    "Zoltan_Create is from [^ ]*libtrilinos_zoltan[^ ]*, but Zoltan_Serialize from [^ ]*libstray"
    FAIL_REGULAR_EXPRESSION "every rank has 300 particles")

if(NOT TARGET zoltan_archive)
  return()
endif()

# Zoltan with ids of 64 bits.
string(REPLACE "FORWARD(Zoltan_get_global_id_type)\n" "" wide_functions "${functions}")
file(CONFIGURE OUTPUT wide/zoltan_functions.h CONTENT "${wide_functions}")
add_library(wide_zoltan SHARED zoltan_archive.c)
target_include_directories(wide_zoltan PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/wide)
target_compile_definitions(wide_zoltan PRIVATE ZOLTAN_LIBRARY="${zoltan_library}" WIDE_IDS)
target_link_libraries(wide_zoltan PRIVATE ${CMAKE_DL_LIBS})
rrcb_add_test(
  NAME clients.wide_ids
  SOURCES wide_ids_test.cpp ../zoltan/program.cpp
  LIBRARIES rrcb::zoltan wide_zoltan
  RANKS 1 2 3 4
  LABELS clients)
target_compile_definitions(clients.wide_ids PRIVATE UNSIGNED_LONG_GLOBAL_IDS)
target_include_directories(clients.wide_ids PRIVATE ../zoltan)
target_include_directories(
  clients.wide_ids SYSTEM PRIVATE $<TARGET_PROPERTY:Zoltan::zoltan,INTERFACE_INCLUDE_DIRECTORIES>)
