# Install and export: find_package(Lambert) gives Lambert::<Module> (VTK shells) and Lambert::<Module>Core.
include(CMakePackageConfigHelpers)
set(lambert_cmake_destination "${CMAKE_INSTALL_LIBDIR}/cmake/lambert")
install(EXPORT LambertCore NAMESPACE Lambert:: FILE LambertCore-targets.cmake
  DESTINATION "${lambert_cmake_destination}")
configure_package_config_file(Utilities/CMake/LambertConfig.cmake.in
  "${CMAKE_BINARY_DIR}/LambertConfig.cmake" INSTALL_DESTINATION "${lambert_cmake_destination}")
write_basic_package_version_file("${CMAKE_BINARY_DIR}/LambertConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/LambertConfig.cmake" "${CMAKE_BINARY_DIR}/LambertConfigVersion.cmake"
  DESTINATION "${lambert_cmake_destination}")
