# Installs the library and the plug-in, so that find_package(rrcb) gives rrcb::rrcb and, where
# Zoltan is found, rrcb::zoltan. The plug-in has an export file of its own: users without Zoltan
# never read it.
set(RRCB_CONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/rrcb)

install(TARGETS rrcb EXPORT rrcbTargets)
install(EXPORT rrcbTargets NAMESPACE rrcb:: DESTINATION ${RRCB_CONFIG_DIR})
install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/include/rrcb ${PROJECT_BINARY_DIR}/src/include/rrcb
  DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  PATTERN zoltan EXCLUDE)

if(RRCB_ZOLTAN)
  install(TARGETS rrcb_zoltan EXPORT rrcbZoltanTargets)
  install(EXPORT rrcbZoltanTargets NAMESPACE rrcb:: DESTINATION ${RRCB_CONFIG_DIR})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/rrcb/zoltan
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/rrcb)
endif()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/rrcbConfig.cmake.in rrcbConfig.cmake
                              INSTALL_DESTINATION ${RRCB_CONFIG_DIR})
write_basic_package_version_file(rrcbConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(
  FILES ${PROJECT_BINARY_DIR}/rrcbConfig.cmake ${PROJECT_BINARY_DIR}/rrcbConfigVersion.cmake
        ${CMAKE_CURRENT_LIST_DIR}/rrcb_trilinos.cmake
  DESTINATION ${RRCB_CONFIG_DIR})
