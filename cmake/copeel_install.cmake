# The installed library: headers under include/copeel, copeel::core for find_package.
include(CMakePackageConfigHelpers)
set(COPEEL_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/copeel)

install(TARGETS copeel_core EXPORT copeelTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/core DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/copeel COMPONENT library FILES_MATCHING PATTERN "*.h" PATTERN "*.glsl")
install(EXPORT copeelTargets NAMESPACE copeel:: DESTINATION ${COPEEL_PACKAGE_DIR} COMPONENT library)

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/copeelConfig.cmake.in ${PROJECT_BINARY_DIR}/copeelConfig.cmake
                              INSTALL_DESTINATION ${COPEEL_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/copeelConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/copeelConfig.cmake ${PROJECT_BINARY_DIR}/copeelConfigVersion.cmake
        DESTINATION ${COPEEL_PACKAGE_DIR} COMPONENT library)
