# Every library that the door stands on, each as one imported target; those of the program alone are in ProgramDependencies.cmake.
find_package(MPI REQUIRED COMPONENTS C CXX)
find_package(Boost REQUIRED)
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE TRUE) # a notice that tells a user of ours nothing
find_package(CGAL REQUIRED)
find_package(Eigen3 REQUIRED CONFIG)
find_package(fmt REQUIRED)
find_package(spdlog REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(tomlplusplus REQUIRED IMPORTED_TARGET tomlplusplus)
pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)
find_package(HDF5 REQUIRED COMPONENTS C)
find_package(EXPAT REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(ZLIB REQUIRED)

# Debian's p4est and cgns carry neither CMake packages nor pkg-config files.
function(quadloop_find_library target header library)
  find_path(${target}_INCLUDE_DIR ${header} REQUIRED)
  find_library(${target}_LIBRARY ${library} REQUIRED)
  add_library(${target} UNKNOWN IMPORTED)
  set_target_properties(${target} PROPERTIES IMPORTED_LOCATION "${${target}_LIBRARY}"
                        INTERFACE_INCLUDE_DIRECTORIES "${${target}_INCLUDE_DIR}")
endfunction()
quadloop_find_library(sc sc.h sc)
quadloop_find_library(p4est p4est.h p4est)
target_link_libraries(p4est INTERFACE sc MPI::MPI_C)
quadloop_find_library(cgns cgnslib.h cgns)
quadloop_find_library(nlopt nlopt.hpp nlopt)
