# What `cmake --install` leaves beside the libraries: a CMake package, so that find_package(quadloop) gives quadloop::quadloop, and the
# headers that its door names, directly or through others.
include(CMakePackageConfigHelpers)
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/quadloop")
install(EXPORT quadloop NAMESPACE quadloop:: FILE quadloopTargets.cmake DESTINATION "${package_folder}" COMPONENT dev)
install(EXPORT quadloop_gis NAMESPACE quadloop:: FILE quadloopGisTargets.cmake DESTINATION "${package_folder}" COMPONENT dev)

# quadloop_install_headers(HEADER ...): these and all of ours that they include, under the paths that an #include names.
function(quadloop_install_headers)
  set(known ${ARGN})
  set(next ${ARGN})
  while(next)
    list(POP_FRONT next header)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${header}")
    get_filename_component(folder "${header}" DIRECTORY)
    install(FILES "${PROJECT_SOURCE_DIR}/${header}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/quadloop/${folder}" COMPONENT dev)
    file(STRINGS "${PROJECT_SOURCE_DIR}/${header}" lines REGEX "^#include \"")
    foreach(line IN LISTS lines)
      string(REGEX REPLACE "^#include \"(.*)\".*" "\\1" named "${line}")
      if(NOT named IN_LIST known)
        list(APPEND known "${named}")
        list(APPEND next "${named}")
      endif()
    endforeach()
  endwhile()
endfunction()
quadloop_install_headers(quadloop/quadloop.hpp io/gis/gis_formats.hpp)

configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/quadloopConfig.cmake.in" "${PROJECT_BINARY_DIR}/quadloopConfig.cmake"
                              INSTALL_DESTINATION "${package_folder}")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/quadloopConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/quadloopConfig.cmake" "${PROJECT_BINARY_DIR}/quadloopConfigVersion.cmake"
              "${CMAKE_CURRENT_LIST_DIR}/Dependencies.cmake" DESTINATION "${package_folder}" COMPONENT dev)
# What the README links, where its links find it.
install(FILES LICENSE README.md CONTRIBUTING.md CHANGELOG.md DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program)
install(DIRECTORY docs cases examples packaging DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT program PATTERN __pycache__ EXCLUDE)

# `cpack` in the build folder: Debian packages of the program, of the library, and of the Python package.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT "the developers of quadloop")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL program dev python)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "${PROJECT_DESCRIPTION}: the program")
set(CPACK_COMPONENT_DEV_DESCRIPTION "${PROJECT_DESCRIPTION}: library and headers")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "${PROJECT_DESCRIPTION}: Python package")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME quadloop)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS openmpi-bin)
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libquadloop-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "quadloop, libopenmpi-dev, libp4est-dev, libeigen3-dev, libnlopt-cxx-dev, libcgns-dev, libhdf5-dev, \
libcairo2-dev, libpng-dev, libcgal-dev, libboost-dev, libtomlplusplus-dev, libfmt-dev, libspdlog-dev, libexpat1-dev, nlohmann-json3-dev, zlib1g-dev, pkg-config")
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-quadloop)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "quadloop, python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-mpi4py, python3-scipy")
include(CPack)
