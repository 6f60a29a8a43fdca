# Zoltan2, as Zoltan2::zoltan2, behind Zoltan::zoltan. Debian's package files for it name targets
# that do not exist, so it is linked by the names of its libraries. Its headers are no C++20.
include(FindPackageHandleStandardArgs)
find_path(ZOLTAN2_INCLUDE_DIR Zoltan2_PartitioningProblem.hpp PATH_SUFFIXES trilinos)
find_path(PTSCOTCH_INCLUDE_DIR ptscotch.h PATH_SUFFIXES scotch)
set(_zoltan2_required ZOLTAN2_INCLUDE_DIR PTSCOTCH_INCLUDE_DIR)
set(_zoltan2_libraries)
foreach(_zoltan2_name IN ITEMS trilinos_zoltan2 trilinos_xpetra trilinos_tpetra trilinos_epetra
                      trilinos_kokkoskernels trilinos_kokkoscore trilinos_teuchoscomm
                      trilinos_teuchosnumerics trilinos_teuchosparameterlist trilinos_teuchosparser
                      trilinos_teuchoscore ptscotch scotch)
  string(TOUPPER ZOLTAN2_${_zoltan2_name}_LIBRARY _zoltan2_variable)
  find_library(${_zoltan2_variable} ${_zoltan2_name})
  mark_as_advanced(${_zoltan2_variable})
  list(APPEND _zoltan2_libraries ${${_zoltan2_variable}})
  list(APPEND _zoltan2_required ${_zoltan2_variable})
endforeach()
mark_as_advanced(ZOLTAN2_INCLUDE_DIR PTSCOTCH_INCLUDE_DIR)
find_package_handle_standard_args(Zoltan2 REQUIRED_VARS ${_zoltan2_required})
if(Zoltan2_FOUND AND NOT TARGET Zoltan2::zoltan2)
  add_library(Zoltan2::zoltan2 INTERFACE IMPORTED GLOBAL)
  target_include_directories(Zoltan2::zoltan2 SYSTEM INTERFACE ${ZOLTAN2_INCLUDE_DIR}
                                                               ${PTSCOTCH_INCLUDE_DIR})
  target_link_libraries(Zoltan2::zoltan2 INTERFACE ${_zoltan2_libraries} Zoltan::zoltan
                                                   MPI::MPI_CXX)
endif()
unset(_zoltan2_name)
unset(_zoltan2_variable)
unset(_zoltan2_libraries)
unset(_zoltan2_required)
