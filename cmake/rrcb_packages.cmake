# Debian packages by CPack, one for each component of the installation (tools/package).
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_STRIP_FILES ON)
set(RRCB_MAINTAINER "The RRCB authors <rrcb@localhost>" CACHE STRING "Of the Debian packages")
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${RRCB_MAINTAINER})
set(CPACK_DEBIAN_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(full_version ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})

# rrcb_package(<component> <package> <section> <summary> <text> [dependencies...])
function(rrcb_package component package section summary text)
  string(TOUPPER ${component} key)
  list(JOIN ARGN ", " depends)
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${package} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/debian/triggers
      PARENT_SCOPE)
  # The first line is the summary.
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${summary}\n${text}" PARENT_SCOPE)
  # Of the packages alone: an installation without a component has none of it.
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION share/doc/${package} RENAME copyright
          COMPONENT ${component} EXCLUDE_FROM_ALL)
  install(FILES ${PROJECT_BINARY_DIR}/packaging/changelog.Debian.gz
          DESTINATION share/doc/${package} COMPONENT ${component} EXCLUDE_FROM_ALL)
endfunction()

set(text "RRCB divides the particles of a parallel code among its processes so that each\n\
gets the same load, by recursive coordinate bisection of what the cells of a\ncoarse mesh hold.")
set(mpi "libopenmpi-dev")
if(MPI_CXX_INCLUDE_DIRS MATCHES mpich)
  set(mpi "libmpich-dev")
endif()
set(CPACK_COMPONENTS_ALL)
rrcb_package(runtime librrcb0 libs "Reduced recursive coordinate bisection (library)" "${text}")
rrcb_package(
  development librrcb-dev libdevel "Reduced recursive coordinate bisection (development)"
  "${text}\n.\nHeaders for C++ and C, module for Fortran, archive,\nfiles for CMake and pkg-config."
  "librrcb0 (= ${full_version})" ${mpi})
if(RRCB_ZOLTAN)
  rrcb_package(
    zoltan librrcb-zoltan libs "Reduced recursive coordinate bisection in Zoltan programs"
    "${text}\n.\nThe plug-in puts it in the place of a method of Zoltan: linked, or preloaded."
    "librrcb-dev (= ${full_version})" libtrilinos-zoltan-dev)
endif()
if(RRCB_TEUCHOS)
  rrcb_package(
    teuchos librrcb-teuchos-dev libdevel
    "Reduced recursive coordinate bisection with Teuchos (development)"
    "${text}\n.\nIts parameters as a validated list, and timers of its stages."
    "librrcb-dev (= ${full_version})" libtrilinos-teuchos-dev libtrilinos-kokkos-dev)
endif()

find_program(RRCB_GZIP gzip)
if(RRCB_GZIP)
  configure_file(packaging/debian/changelog.in packaging/changelog.Debian @ONLY)
  execute_process(COMMAND ${RRCB_GZIP} -9nfk ${PROJECT_BINARY_DIR}/packaging/changelog.Debian)
endif()
include(CPack)
