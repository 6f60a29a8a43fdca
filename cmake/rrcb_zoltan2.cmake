# Zoltan2::zoltan2 where Zoltan2 is installed. Debian's package files for it name targets that do not
# exist, so it is linked by the names of its libraries. Its headers are no C++20.
include_guard(GLOBAL)
find_path(RRCB_ZOLTAN2_INCLUDE_DIR Zoltan2_PartitioningProblem.hpp PATH_SUFFIXES trilinos)
find_path(RRCB_SCOTCH_INCLUDE_DIR ptscotch.h PATH_SUFFIXES scotch)
set(libraries)
set(missing)
foreach(name IN ITEMS trilinos_zoltan2 trilinos_xpetra trilinos_tpetra trilinos_epetra
                      trilinos_kokkoskernels trilinos_kokkoscore trilinos_teuchoscomm
                      trilinos_teuchosnumerics trilinos_teuchosparameterlist trilinos_teuchosparser
                      trilinos_teuchoscore ptscotch scotch)
  string(TOUPPER RRCB_${name}_LIBRARY variable)
  find_library(${variable} ${name})
  list(APPEND libraries ${${variable}})
  if(NOT ${variable})
    list(APPEND missing ${name})
  endif()
endforeach()
if(missing OR NOT RRCB_ZOLTAN2_INCLUDE_DIR OR NOT RRCB_SCOTCH_INCLUDE_DIR)
  message(STATUS "Zoltan2: left out, because it is not installed (Debian packages"
                 " libtrilinos-zoltan2-dev libtrilinos-tpetra-dev libtrilinos-xpetra-dev"
                 " libtrilinos-epetra-dev libtrilinos-kokkos-kernels-dev libptscotch-dev)")
  return()
endif()
add_library(Zoltan2::zoltan2 INTERFACE IMPORTED GLOBAL)
target_include_directories(Zoltan2::zoltan2 SYSTEM INTERFACE ${RRCB_ZOLTAN2_INCLUDE_DIR}
                                                             ${RRCB_SCOTCH_INCLUDE_DIR})
target_link_libraries(Zoltan2::zoltan2 INTERFACE ${libraries} Zoltan::zoltan MPI::MPI_CXX)
