# What `cmake --install` leaves beside the modules: a CMake package, so that find_package(quadloop) gives quadloop::mesh and the rest.
include(CMakePackageConfigHelpers)
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/quadloop")
install(EXPORT quadloop NAMESPACE quadloop:: FILE quadloopTargets.cmake DESTINATION "${package_folder}")
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/quadloopConfig.cmake.in" "${PROJECT_BINARY_DIR}/quadloopConfig.cmake"
                              INSTALL_DESTINATION "${package_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/quadloopConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/quadloopConfig.cmake" "${PROJECT_BINARY_DIR}/quadloopConfigVersion.cmake"
              "${CMAKE_CURRENT_LIST_DIR}/Dependencies.cmake" DESTINATION "${package_folder}")
# What the README links, where its links find it.
install(FILES LICENSE README.md CONTRIBUTING.md CHANGELOG.md DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY docs cases DESTINATION "${CMAKE_INSTALL_DOCDIR}" PATTERN __pycache__ EXCLUDE)
