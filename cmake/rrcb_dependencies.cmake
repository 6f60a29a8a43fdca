# Finds what the enabled parts stand on.
include(rrcb_left_out)
include(rrcb_trilinos)

# rrcb_part(<option> <default> <help>)
#
# A part of the project: ON, OFF, or AUTO, which is on where its packages are.
function(rrcb_part option default help)
  set(${option} ${default} CACHE STRING "${help}: ON, OFF or AUTO")
  set_property(CACHE ${option} PROPERTY STRINGS AUTO ON OFF)
endfunction()

# rrcb_needs(<option> <found> <what> [Debian packages that have it...])
#
# Where a part lacks what it needs, AUTO leaves it out; ON fails.
function(rrcb_needs option found what)
  if(NOT ${option} OR ${found})
    return()
  endif()
  if(NOT ${option} STREQUAL "AUTO")
    message(FATAL_ERROR "${option}=${${option}} needs ${what}, not found (Debian packages: ${ARGN});"
                        " or leave it out: ${option}=OFF")
  endif()
  rrcb_left_out(${option} "${what} was not found" ${ARGN})
  set(${option} OFF PARENT_SCOPE)
endfunction()

set(examples OFF)
if(RRCB_EXAMPLES)
  set(examples AUTO)
endif()
set(top_level_parts OFF)
if(PROJECT_IS_TOP_LEVEL)
  set(top_level_parts AUTO)
endif()
rrcb_part(RRCB_ZOLTAN AUTO "The Zoltan plug-in (needs Zoltan of Trilinos)")
rrcb_part(RRCB_TEUCHOS AUTO "The parameter lists and timers of Trilinos (needs Teuchos)")
rrcb_part(RRCB_FORTRAN ${top_level_parts} "The Fortran module (needs a Fortran compiler)")
rrcb_part(RRCB_MPM ${examples} "The material point example")
rrcb_part(RRCB_MPM_SCENES ${examples}
          "Its scene files and its program (need Teuchos and muParser)")
rrcb_part(RRCB_COMPARISONS ${examples}
          "The comparison driver (needs the plug-in and the material point example)")
rrcb_part(RRCB_BENCHMARKS ${top_level_parts} "The benchmarks (need Google Benchmark)")

if(RRCB_FORTRAN)
  include(CheckLanguage)
  check_language(Fortran)
  rrcb_needs(RRCB_FORTRAN CMAKE_Fortran_COMPILER "a Fortran compiler" gfortran)
endif()
if(RRCB_FORTRAN)
  enable_language(Fortran)
endif()

find_package(MPI REQUIRED COMPONENTS C CXX)

if(RRCB_ZOLTAN)
  rrcb_find_trilinos(Zoltan)
  rrcb_needs(RRCB_ZOLTAN "TARGET;Zoltan::zoltan" "Zoltan of Trilinos" libtrilinos-zoltan-dev)
endif()
if(RRCB_TEUCHOS OR RRCB_MPM_SCENES)
  rrcb_find_trilinos(Teuchos)
  foreach(option IN ITEMS RRCB_TEUCHOS RRCB_MPM_SCENES)
    rrcb_needs(${option} "TARGET;Teuchos::teuchos" "Teuchos of Trilinos" libtrilinos-teuchos-dev
               libtrilinos-kokkos-dev)
  endforeach()
endif()
if(RRCB_MPM_SCENES)
  find_package(muParser MODULE QUIET)
  rrcb_needs(RRCB_MPM_SCENES muParser_FOUND muParser libmuparser-dev)
  rrcb_needs(RRCB_MPM_SCENES RRCB_MPM RRCB_MPM)
endif()
foreach(option IN ITEMS RRCB_ZOLTAN RRCB_MPM_SCENES)
  rrcb_needs(RRCB_COMPARISONS ${option} ${option})
endforeach()

find_package(Eigen3 3.3 REQUIRED NO_MODULE)

if(RRCB_BENCHMARKS)
  find_package(benchmark QUIET)
  rrcb_needs(RRCB_BENCHMARKS benchmark_FOUND "Google Benchmark" libbenchmark-dev)
endif()
