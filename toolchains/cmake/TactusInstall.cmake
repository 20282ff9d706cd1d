# cmake --install: the controller's libraries with their headers, the tactus program with its examples, and the CMake package by which
# another project says find_package(tactus) and links tactus::rendering or tactus::firmware. Debian's packages are made of the same
# files: debian/*.install says which package has which.

include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/tactus")
get_property(libraries GLOBAL PROPERTY TACTUS_LIBRARIES)

install(TARGETS ${libraries} EXPORT tactusTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(EXPORT tactusTargets NAMESPACE tactus:: DESTINATION "${package_dir}")
install(DIRECTORY rendering hal drivers firmware DESTINATION "${TACTUS_INSTALL_INCLUDEDIR}"
        FILES_MATCHING PATTERN "*.h")
if(TARGET tactus)
  install(TARGETS tactus RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  install(DIRECTORY host_tools/examples DESTINATION "${CMAKE_INSTALL_DATADIR}/tactus" USE_SOURCE_PERMISSIONS PATTERN out EXCLUDE)
  install(FILES host_tools/cli/completion.bash DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" RENAME tactus)
  install(FILES host_tools/cli/completion.zsh DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions" RENAME _tactus)
  install(FILES host_tools/cli/completion.fish DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d" RENAME tactus.fish)
endif()
install(FILES LICENSE README.md CHANGELOG.md DESTINATION "${CMAKE_INSTALL_DOCDIR}")

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/tactusConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/tactusConfig.cmake" INSTALL_DESTINATION "${package_dir}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/tactusConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/tactusConfig.cmake" "${PROJECT_BINARY_DIR}/tactusConfigVersion.cmake"
        DESTINATION "${package_dir}")

add_custom_target(uninstall
  COMMAND "${CMAKE_COMMAND}" -D "BUILD_DIR=${PROJECT_BINARY_DIR}" -P "${CMAKE_CURRENT_LIST_DIR}/TactusUninstall.cmake" USES_TERMINAL VERBATIM)
