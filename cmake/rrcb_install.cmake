# Installs the libraries, so that find_package(rrcb) provides rrcb::rrcb, and with components rrcb::zoltan and
# rrcb::teuchos. These have export files of their own: users without Trilinos never read them.
set(RRCB_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/rrcb)

# Installs targets with what belongs to them, all of it as one component, but for libraries that
# programs load, which are another.
function(rrcb_install_targets export component runtime)
  install(
    TARGETS ${ARGN}
    EXPORT ${export}
    LIBRARY COMPONENT ${runtime} NAMELINK_COMPONENT ${component}
    ARCHIVE COMPONENT ${component})
  install(EXPORT ${export} NAMESPACE rrcb:: DESTINATION ${RRCB_CONFIG_DIR}
          COMPONENT ${component})
endfunction()

# Packages of some systems must not hold an archive beside a shared library.
set(archive development)
if(BUILD_SHARED_LIBS)
  set(archive static)
endif()
rrcb_install_targets(rrcbStaticTargets ${archive} ${archive} rrcb_static)
rrcb_install_targets(rrcbTargets development runtime rrcb rrcb_shared rrcb_experimental)
install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/include/rrcb
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT development
  PATTERN zoltan EXCLUDE
  PATTERN teuchos EXCLUDE)
install(FILES ${PROJECT_BINARY_DIR}/src/include/rrcb/version.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rrcb COMPONENT development)

if(RRCB_ZOLTAN)
  rrcb_install_targets(rrcbZoltanTargets zoltan zoltan rrcb_zoltan rrcb_zoltan_static)
  install(
    DIRECTORY ${PROJECT_SOURCE_DIR}/include/rrcb/zoltan
              ${PROJECT_BINARY_DIR}/src/zoltan/include/rrcb/zoltan
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rrcb
    COMPONENT zoltan)
endif()
if(RRCB_TEUCHOS)
  rrcb_install_targets(rrcbTeuchosTargets teuchos teuchos rrcb_teuchos)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/rrcb/teuchos
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rrcb COMPONENT teuchos)
endif()
if(RRCB_FORTRAN)
  rrcb_install_targets(rrcbFortranTargets development development rrcb_fortran)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/src/fortran/modules/ DESTINATION ${RRCB_MODULE_DIR}
          COMPONENT development)
endif()

# With the archive, a program that is not linked by C++ links these.
set(RRCB_CXX_LIBRARIES ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
list(FILTER RRCB_CXX_LIBRARIES INCLUDE REGEX "^(stdc\\+\\+|c\\+\\+|m)$")
list(REMOVE_DUPLICATES RRCB_CXX_LIBRARIES)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/rrcbConfig.cmake.in rrcbConfig.cmake
                              INSTALL_DESTINATION ${RRCB_CONFIG_DIR})
write_basic_package_version_file(rrcbConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(
  FILES ${PROJECT_BINARY_DIR}/rrcbConfig.cmake ${PROJECT_BINARY_DIR}/rrcbConfigVersion.cmake
        ${CMAKE_CURRENT_LIST_DIR}/rrcb_probe.cmake
        ${CMAKE_CURRENT_LIST_DIR}/rrcb_trilinos.cmake
        ${CMAKE_CURRENT_LIST_DIR}/rrcb_without_cxx.cmake
  DESTINATION ${RRCB_CONFIG_DIR}
  COMPONENT development)
include(${CMAKE_CURRENT_LIST_DIR}/rrcb_pkg_config.cmake)
