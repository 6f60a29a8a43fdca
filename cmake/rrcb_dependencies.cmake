# Finds what the enabled parts stand on.
include(rrcb_left_out)
include(rrcb_trilinos)
include(rrcb_probe)

# rrcb_part(<option> <default> <help>)
#
# A part of the project: ON, OFF, or AUTO, which is on where its packages are.
function(rrcb_part option default help)
  set(${option} ${default} CACHE STRING "${help}: ON, OFF or AUTO")
  set_property(CACHE ${option} PROPERTY STRINGS AUTO ON OFF)
endfunction()

# rrcb_needs(<option> <found> <what> [package of CMake])
#
# If a part lacks what it needs, AUTO leaves it out; ON fails.
function(rrcb_needs option found what)
  if(NOT ${option} OR ${found})
    return()
  endif()
  set(absence "it needs ${what}")
  if(ARGN)
    rrcb_absence(absence "${what}" ${ARGN})
  endif()
  if(NOT ${option} STREQUAL "AUTO")
    rrcb_packages_of(packages ${option})
    list(JOIN packages " " packages)
    message(FATAL_ERROR "${option}=${${option}} needs ${what}; ${absence} (Debian packages: ${packages});"
                        " or leave it out: ${option}=OFF")
  endif()
  rrcb_left_out(${option} "${absence}")
  set(${option} OFF PARENT_SCOPE)
endfunction()

# rrcb_requires(<found> <what> <variable> <its value> <Debian packages that have it...>)
function(rrcb_requires found what variable value)
  if(NOT ${found})
    list(JOIN ARGN " " packages)
    message(FATAL_ERROR "RRCB needs ${what}, not found: install it (Debian packages: ${packages}), "
                        "or set ${variable} to ${value}")
  endif()
endfunction()

# rrcb_find_mpi(<languages and options of find_package>)
#
# FindMPI ends in an error that names no fix if there are compilers of MPI but no headers. Debian's
# python3-mpi4py installs the compilers only.
macro(rrcb_find_mpi)
  find_program(RRCB_MPI_WRAPPER NAMES ${MPI_CXX_COMPILER} mpicxx HINTS ${MPI_HOME} ENV MPI_HOME
               PATH_SUFFIXES bin NO_CACHE)
  set(flags)
  if(RRCB_MPI_WRAPPER)
    execute_process(COMMAND ${RRCB_MPI_WRAPPER} -show OUTPUT_VARIABLE flags ERROR_QUIET)
  endif()
  string(REGEX MATCH " -I([^ \n]+)" flags "${flags}")
  if(NOT flags OR EXISTS "${CMAKE_MATCH_1}")
    find_package(MPI COMPONENTS ${ARGN})
  endif()
  rrcb_requires(MPI_FOUND "MPI's library and headers" MPI_HOME "its folder" libopenmpi-dev
                openmpi-bin)
endmacro()

set(examples OFF)
if(RRCB_EXAMPLES)
  set(examples AUTO)
endif()
set(top_level_parts OFF)
if(PROJECT_IS_TOP_LEVEL)
  set(top_level_parts AUTO)
endif()
rrcb_part(RRCB_TESTS ${top_level_parts} "The tests (need GoogleTest)")
rrcb_part(RRCB_ZOLTAN ${top_level_parts} "The Zoltan plug-in (needs Zoltan of Trilinos)")
rrcb_part(RRCB_TEUCHOS ${top_level_parts} "The parameter lists of Trilinos (needs Teuchos)")
rrcb_part(RRCB_FORTRAN ${top_level_parts} "The Fortran module (needs a Fortran compiler)")
rrcb_part(RRCB_MPM ${examples} "The material point example")
rrcb_part(RRCB_MPM_SCENES ${examples}
          "Its scene files and its program (need Teuchos)")
rrcb_part(RRCB_COMPARISONS ${examples}
          "The comparison driver (needs the plug-in and the material point example)")

if(RRCB_FORTRAN)
  include(CheckLanguage)
  # Looks again for a compiler that an earlier run has not found.
  if(NOT CMAKE_Fortran_COMPILER)
    unset(CMAKE_Fortran_COMPILER CACHE)
  endif()
  check_language(Fortran)
  rrcb_needs(RRCB_FORTRAN CMAKE_Fortran_COMPILER "a Fortran compiler" Fortran)
endif()
if(RRCB_FORTRAN)
  enable_language(Fortran)
endif()

set(fortran)
if(RRCB_FORTRAN)
  set(fortran OPTIONAL_COMPONENTS Fortran)
endif()
rrcb_find_mpi(C CXX ${fortran})
if(RRCB_ZOLTAN)
  rrcb_find_trilinos(Zoltan)
  rrcb_needs(RRCB_ZOLTAN "TARGET;Zoltan::zoltan" "Zoltan of Trilinos" Zoltan)
endif()
if(RRCB_TEUCHOS OR RRCB_MPM_SCENES)
  rrcb_find_trilinos(Teuchos)
  foreach(option IN ITEMS RRCB_TEUCHOS RRCB_MPM_SCENES)
    rrcb_needs(${option} "TARGET;Teuchos::teuchos" "Teuchos of Trilinos" Teuchos)
  endforeach()
endif()
if(RRCB_MPM_SCENES)
  rrcb_needs(RRCB_MPM_SCENES RRCB_MPM RRCB_MPM)
endif()
foreach(option IN ITEMS RRCB_ZOLTAN RRCB_MPM_SCENES)
  rrcb_needs(RRCB_COMPARISONS ${option} ${option})
endforeach()

if(RRCB_TESTS)
  rrcb_find_package(GTest)
  rrcb_needs(RRCB_TESTS GTest_FOUND "GoogleTest" GTest)
endif()
# Tests compare with Eigen; the library needs none. Eigen 5 refuses to be found as 3.4 or newer.
if(RRCB_TESTS)
  rrcb_find_package(Eigen3)
  rrcb_needs(RRCB_TESTS "TARGET;Eigen3::Eigen" "Eigen 3.4 or newer" Eigen3)
endif()

# The library's own code needs no Kokkos: tests and examples do.
if(RRCB_TESTS OR RRCB_EXAMPLES)
  rrcb_find_kokkos()
  if(NOT TARGET Kokkos::kokkos)
    rrcb_absence(absence Kokkos KokkosCore Kokkos)
    rrcb_left_out("tests and example of Kokkos" "${absence}")
  endif()
  # With the MPI of Trilinos, as Teuchos.
  if(RRCB_TEUCHOS)
    rrcb_find_trilinos(TpetraCore)
  endif()
endif()
