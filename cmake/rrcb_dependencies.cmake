# Finds what the enabled parts stand on; a part whose package of Trilinos is missing is left out.
include(rrcb_trilinos)

find_package(MPI REQUIRED COMPONENTS C CXX)
find_package(Eigen3 3.3 REQUIRED NO_MODULE)

function(rrcb_leave_out_unless_found option package debian_package)
  string(TOLOWER ${package} name)
  if(NOT ${option})
    return()
  endif()
  rrcb_find_trilinos(${package})
  if(NOT TARGET ${package}::${name})
    message(STATUS "${option}: left out, because ${package} of Trilinos was not found"
                   " (Debian package ${debian_package})")
    set(${option} OFF PARENT_SCOPE)
  endif()
endfunction()

rrcb_leave_out_unless_found(RRCB_ZOLTAN Zoltan libtrilinos-zoltan-dev)
rrcb_leave_out_unless_found(RRCB_TEUCHOS Teuchos libtrilinos-teuchos-dev)
rrcb_leave_out_unless_found(RRCB_MPM Teuchos libtrilinos-teuchos-dev)
if(RRCB_MPM)
  find_path(MUPARSER_INCLUDE_DIR muParser.h)
  find_library(MUPARSER_LIBRARY muparser)
  mark_as_advanced(MUPARSER_INCLUDE_DIR MUPARSER_LIBRARY)
  if(MUPARSER_INCLUDE_DIR AND MUPARSER_LIBRARY)
    add_library(muparser::muparser UNKNOWN IMPORTED)
    set_target_properties(
      muparser::muparser PROPERTIES IMPORTED_LOCATION ${MUPARSER_LIBRARY}
                                    INTERFACE_INCLUDE_DIRECTORIES ${MUPARSER_INCLUDE_DIR})
  else()
    message(STATUS "RRCB_MPM: left out, because muParser was not found"
                   " (Debian package libmuparser-dev)")
    set(RRCB_MPM OFF)
  endif()
endif()
if(RRCB_COMPARISONS AND NOT (RRCB_ZOLTAN AND RRCB_MPM))
  message(STATUS "RRCB_COMPARISONS: left out, because it compares RRCB with Zoltan on the slope"
                 " (needs RRCB_ZOLTAN and RRCB_MPM)")
  set(RRCB_COMPARISONS OFF)
endif()

if(RRCB_BENCHMARKS)
  find_package(benchmark QUIET)
  if(NOT benchmark_FOUND)
    message(STATUS "RRCB_BENCHMARKS: left out, because Google Benchmark was not found"
                   " (Debian package libbenchmark-dev)")
    set(RRCB_BENCHMARKS OFF)
  endif()
endif()
