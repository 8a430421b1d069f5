# Install and export: find_package(Lambert) gives Lambert::<Module> (VTK shells) and Lambert::<Module>Core.
include(CMakePackageConfigHelpers)
set(lambert_cmake_destination "${CMAKE_INSTALL_LIBDIR}/cmake/lambert")
install(EXPORT LambertCore NAMESPACE Lambert:: FILE LambertCore-targets.cmake
  DESTINATION "${lambert_cmake_destination}")
# Headers under the names that ours include each other by: Scene/vtkSceneLoader.h, Engine/RadiosityRun.h.
foreach(module IN ITEMS Common Scene Clustering Visibility Radiosity Classical Reference Display Engine)
  file(GLOB lambert_headers CONFIGURE_DEPENDS "${CMAKE_SOURCE_DIR}/Modules/${module}/*.h")
  install(FILES ${lambert_headers} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/lambert/${module}")
endforeach()
configure_package_config_file(Utilities/CMake/LambertConfig.cmake.in
  "${CMAKE_BINARY_DIR}/LambertConfig.cmake" INSTALL_DESTINATION "${lambert_cmake_destination}")
write_basic_package_version_file("${CMAKE_BINARY_DIR}/LambertConfigVersion.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/LambertConfig.cmake" "${CMAKE_BINARY_DIR}/LambertConfigVersion.cmake"
  DESTINATION "${lambert_cmake_destination}")
