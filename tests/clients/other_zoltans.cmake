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
    "Zoltan_Create is from [^ ]*libtrilinos_zoltan[^ ]*, but Zoltan_LB_Box_Assign from [^ ]*libstray"
    FAIL_REGULAR_EXPRESSION "every rank has 300 particles")

if(NOT TARGET zoltan_archive)
  return()
endif()

# Zoltan without the functions that not every Zoltan has: shared, as an archive, and under Fortran.
# Debian's Zoltan, which has them, is loaded behind it, as the plug-in depends on it.
set(fewer_functions ${functions})
foreach(optional IN ITEMS RCB_Partition_Tree Serialize_Size Serialize Deserialize)
  string(REPLACE "FORWARD(Zoltan_${optional})\n" "" fewer_functions "${fewer_functions}")
endforeach()
file(CONFIGURE OUTPUT fewer/zoltan_functions.h CONTENT "${fewer_functions}")
foreach(kind IN ITEMS SHARED STATIC)
  string(TOLOWER fewer_functions_${kind} library)
  add_library(${library} ${kind} zoltan_archive.c)
  target_include_directories(${library} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/fewer)
  target_compile_definitions(${library} PRIVATE ZOLTAN_LIBRARY="${zoltan_library}")
  target_link_libraries(${library} PRIVATE ${CMAKE_DL_LIBS})
endforeach()
rrcb_add_test(
  NAME clients.fewer_functions
  SOURCES fewer_functions_test.cpp ../zoltan/program.cpp
  LIBRARIES rrcb::zoltan fewer_functions_shared
  RANKS 1 3
  LABELS clients)
target_include_directories(clients.fewer_functions PRIVATE ../zoltan)
target_include_directories(
  clients.fewer_functions SYSTEM
  PRIVATE $<TARGET_PROPERTY:Zoltan::zoltan,INTERFACE_INCLUDE_DIRECTORIES>)
add_static_test(fewer_functions_static fewer_functions_static)
if(can_preload)
  add_executable(fewer_functions_client ${PROJECT_SOURCE_DIR}/examples/zoltan_drop_in/main.cpp)
  target_include_directories(
    fewer_functions_client SYSTEM
    PRIVATE $<TARGET_PROPERTY:Zoltan::zoltan,INTERFACE_INCLUDE_DIRECTORIES>)
  target_link_libraries(fewer_functions_client PRIVATE fewer_functions_shared MPI::MPI_CXX)
  add_client_run(fewer_functions.preloaded ${preloaded} $<TARGET_FILE:fewer_functions_client> RRCB)
endif()

# The same with ids of 64 bits.
string(REPLACE "FORWARD(Zoltan_get_global_id_type)\n" "" wide_functions "${fewer_functions}")
file(CONFIGURE OUTPUT wide/zoltan_functions.h CONTENT "${wide_functions}")
add_library(wide_zoltan SHARED zoltan_archive.c)
target_include_directories(wide_zoltan PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/wide)
target_compile_definitions(wide_zoltan PRIVATE ZOLTAN_LIBRARY="${zoltan_library}" WIDE_IDS)
target_link_libraries(wide_zoltan PRIVATE ${CMAKE_DL_LIBS})
rrcb_add_test(
  NAME clients.wide_ids
  SOURCES wide_ids_test.cpp ../zoltan/program.cpp
  LIBRARIES rrcb::zoltan wide_zoltan
  RANKS 1 3
  LABELS clients)
target_compile_definitions(clients.wide_ids PRIVATE UNSIGNED_LONG_GLOBAL_IDS)
target_include_directories(clients.wide_ids PRIVATE ../zoltan)
target_include_directories(
  clients.wide_ids SYSTEM PRIVATE $<TARGET_PROPERTY:Zoltan::zoltan,INTERFACE_INCLUDE_DIRECTORIES>)
