# find_package(Pneuma) from an outside project: `cmake --install build/release --component dev --prefix PREFIX`.
include(CMakePackageConfigHelpers)
set(package "${CMAKE_INSTALL_LIBDIR}/cmake/Pneuma")
install(EXPORT PneumaTargets NAMESPACE pneuma:: DESTINATION "${package}" COMPONENT dev)
configure_package_config_file(
  cmake/PneumaConfig.cmake.in "${CMAKE_CURRENT_BINARY_DIR}/generated/install/PneumaConfig.cmake"
  INSTALL_DESTINATION "${package}" NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change what outside projects compile against.
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/generated/install/PneumaConfigVersion.cmake"
                                 COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/generated/install/PneumaConfig.cmake"
              "${CMAKE_CURRENT_BINARY_DIR}/generated/install/PneumaConfigVersion.cmake"
        DESTINATION "${package}" COMPONENT dev)
