# What `cmake --install` leaves beside the libraries: a CMake package, so that find_package(quadloop) gives quadloop::quadloop, and the
# headers that its door names, directly or through others.
include(CMakePackageConfigHelpers)
set(package_folder "${CMAKE_INSTALL_LIBDIR}/cmake/quadloop")
install(EXPORT quadloop NAMESPACE quadloop:: FILE quadloopTargets.cmake DESTINATION "${package_folder}")
install(EXPORT quadloop_gis NAMESPACE quadloop:: FILE quadloopGisTargets.cmake DESTINATION "${package_folder}")

# quadloop_install_headers(HEADER ...): these and all of ours that they include, under the paths that an #include names.
function(quadloop_install_headers)
  set(known ${ARGN})
  set(next ${ARGN})
  while(next)
    list(POP_FRONT next header)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${header}")
    get_filename_component(folder "${header}" DIRECTORY)
    install(FILES "${PROJECT_SOURCE_DIR}/${header}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/quadloop/${folder}")
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
              "${CMAKE_CURRENT_LIST_DIR}/Dependencies.cmake" DESTINATION "${package_folder}")
# What the README links, where its links find it.
install(FILES LICENSE README.md CONTRIBUTING.md CHANGELOG.md DESTINATION "${CMAKE_INSTALL_DOCDIR}")
install(DIRECTORY docs cases examples DESTINATION "${CMAKE_INSTALL_DOCDIR}" PATTERN __pycache__ EXCLUDE)
