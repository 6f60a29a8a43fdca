# Installs the libraries, so that find_package(rrcb) gives rrcb::rrcb and, where Zoltan and Teuchos
# are found, rrcb::zoltan and rrcb::teuchos. These have export files of their own: users without
# Trilinos never read them.
set(RRCB_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/rrcb)

install(TARGETS rrcb EXPORT rrcbTargets)
install(EXPORT rrcbTargets NAMESPACE rrcb:: DESTINATION ${RRCB_CONFIG_DIR})
install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/include/rrcb ${PROJECT_BINARY_DIR}/src/include/rrcb
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  PATTERN zoltan EXCLUDE
  PATTERN teuchos EXCLUDE)

if(RRCB_ZOLTAN)
  install(TARGETS rrcb_zoltan rrcb_zoltan_static EXPORT rrcbZoltanTargets)
  install(EXPORT rrcbZoltanTargets NAMESPACE rrcb:: DESTINATION ${RRCB_CONFIG_DIR})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/rrcb/zoltan
                    ${PROJECT_BINARY_DIR}/src/zoltan/include/rrcb/zoltan
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rrcb)
endif()
if(RRCB_TEUCHOS)
  install(TARGETS rrcb_teuchos EXPORT rrcbTeuchosTargets)
  install(EXPORT rrcbTeuchosTargets NAMESPACE rrcb:: DESTINATION ${RRCB_CONFIG_DIR})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/rrcb/teuchos
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rrcb)
endif()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/rrcbConfig.cmake.in rrcbConfig.cmake
                              INSTALL_DESTINATION ${RRCB_CONFIG_DIR})
write_basic_package_version_file(rrcbConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(
  FILES ${PROJECT_BINARY_DIR}/rrcbConfig.cmake ${PROJECT_BINARY_DIR}/rrcbConfigVersion.cmake
        ${CMAKE_CURRENT_LIST_DIR}/rrcb_trilinos.cmake
  DESTINATION ${RRCB_CONFIG_DIR})
