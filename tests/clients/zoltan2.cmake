# Zoltan2 over the plug-in, where it is installed. Debian's package files for it name targets that do
# not exist, so it is linked by the names of its libraries.
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
  message(STATUS "Test of Zoltan2: left out, because it is not installed (Debian packages"
                 " libtrilinos-zoltan2-dev libtrilinos-tpetra-dev libtrilinos-xpetra-dev"
                 " libtrilinos-epetra-dev libtrilinos-kokkos-kernels-dev libptscotch-dev)")
  return()
endif()

add_executable(zoltan2_client zoltan2_client.cpp)
rrcb_set_warnings(zoltan2_client)
# Its headers are no C++20.
set_target_properties(zoltan2_client PROPERTIES CXX_STANDARD 17)
target_include_directories(zoltan2_client SYSTEM PRIVATE ${RRCB_ZOLTAN2_INCLUDE_DIR}
                                                         ${RRCB_SCOTCH_INCLUDE_DIR})
target_link_libraries(zoltan2_client PRIVATE rrcb::zoltan ${libraries} Zoltan::zoltan MPI::MPI_CXX)
add_client_run(zoltan2.rcb $<TARGET_FILE:zoltan2_client> RCB)
add_client_run(zoltan2.rrcb $<TARGET_FILE:zoltan2_client> RRCB)
