# "cmake --install": the core as a package for CMake and pkg-config. It can be moved once it is installed.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/polylidar")
set_target_properties(polylidar_core PROPERTIES EXPORT_NAME core OUTPUT_NAME polylidar)
install(TARGETS polylidar_core EXPORT polylidar_targets
  ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT polylidar
  INCLUDES DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
install(DIRECTORY include/polylidar TYPE INCLUDE COMPONENT polylidar FILES_MATCHING PATTERN "*.hpp")
install(FILES ../LICENSE TYPE DOC COMPONENT polylidar)

install(EXPORT polylidar_targets DESTINATION "${package_folder}" COMPONENT polylidar
  NAMESPACE polylidar:: FILE polylidar-targets.cmake)
configure_package_config_file(cmake/polylidar-config.cmake.in polylidar-config.cmake
  INSTALL_DESTINATION "${package_folder}" NO_SET_AND_CHECK_MACRO)
# Before 1.0 a new minor version may change the interface.
write_basic_package_version_file(polylidar-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/polylidar-config.cmake" "${CMAKE_CURRENT_BINARY_DIR}/polylidar-config-version.cmake"
  DESTINATION "${package_folder}" COMPONENT polylidar)

# From the folder of polylidar.pc up to the prefix.
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX
  BASE_DIRECTORY "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" OUTPUT_VARIABLE prefix_from_pkgconfig)
configure_file(cmake/polylidar.pc.in polylidar.pc @ONLY)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/polylidar.pc"
  DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT polylidar)
