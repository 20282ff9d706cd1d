# cmake --install: the controller's libraries with their headers, the tactus program, and the CMake package by which
# another project says find_package(tactus) and links tactus::rendering or tactus::firmware.

include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/tactus")
get_property(libraries GLOBAL PROPERTY TACTUS_LIBRARIES)

install(TARGETS ${libraries} EXPORT tactusTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(EXPORT tactusTargets NAMESPACE tactus:: DESTINATION "${package_dir}")
install(DIRECTORY rendering hal drivers firmware DESTINATION "${TACTUS_INSTALL_INCLUDEDIR}"
        FILES_MATCHING PATTERN "*.h")
if(TARGET tactus)
  install(TARGETS tactus RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
endif()
install(FILES LICENSE README.md CHANGELOG.md DESTINATION "${CMAKE_INSTALL_DOCDIR}")

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/tactusConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/tactusConfig.cmake" INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/tactusConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/tactusConfig.cmake" "${PROJECT_BINARY_DIR}/tactusConfigVersion.cmake"
        DESTINATION "${package_dir}")
