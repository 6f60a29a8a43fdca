# The system's Zoltan as Debian's Trilinos 16 exports it: one target that links another, which links a package
# whose files need not be there.
find_library(ZOLTAN_TARGETS_FILE trilinos_zoltan REQUIRED)
find_path(ZOLTAN_TARGETS_FOLDER zoltan.h PATH_SUFFIXES trilinos REQUIRED)

add_library(tribits::Scotch::scotch UNKNOWN IMPORTED)
set_target_properties(tribits::Scotch::scotch PROPERTIES IMPORTED_LOCATION /missing/libscotch.so)
add_library(Scotch::all_libs INTERFACE IMPORTED)
set_target_properties(
  Scotch::all_libs PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "/missing/scotch;/usr/include"
                              INTERFACE_LINK_LIBRARIES tribits::Scotch::scotch)
add_library(Zoltan::trilinos_zoltan SHARED IMPORTED)
set_target_properties(
  Zoltan::trilinos_zoltan
  PROPERTIES IMPORTED_CONFIGURATIONS NONE
             IMPORTED_LOCATION_NONE ${ZOLTAN_TARGETS_FILE}
             INTERFACE_INCLUDE_DIRECTORIES ${ZOLTAN_TARGETS_FOLDER}
             INTERFACE_LINK_LIBRARIES "Scotch::all_libs;m")
add_library(Zoltan::all_libs INTERFACE IMPORTED)
set_target_properties(Zoltan::all_libs PROPERTIES INTERFACE_LINK_LIBRARIES Zoltan::trilinos_zoltan)
set(Zoltan_LIBRARIES Zoltan::all_libs)
