# One interface target for how every source of ours is compiled.
add_library(quadloop_options INTERFACE)
target_include_directories(quadloop_options INTERFACE "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>"
                                                      "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/quadloop>")
target_compile_features(quadloop_options INTERFACE cxx_std_20)
# Exact predicates, and one result on every machine, need each operation rounded on its own: no fused multiply-add.
# Position-independent functions are inlined like others, as nobody replaces them at run time.
target_compile_options(quadloop_options INTERFACE -ffp-contract=off -fno-semantic-interposition $<BUILD_INTERFACE:-Wall;-Wextra;-Wshadow;-Wconversion>)
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC warns of types of unnamed namespaces in headers, and takes the sources of one unit for headers. Units need more memory than it expects: it
  # would spend an eighth of its time on collecting garbage.
  target_compile_options(quadloop_options INTERFACE $<BUILD_INTERFACE:-Wno-subobject-linkage> $<BUILD_INTERFACE:--param=ggc-min-heapsize=400000>)
endif()
# Other compilers and other flags have warnings of their own, which must not stop a user.
option(QUADLOOP_WERROR "warnings of GCC 12 are errors where CMAKE_CXX_FLAGS is empty" OFF)
if(QUADLOOP_WERROR AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION MATCHES "^12\\." AND "${CMAKE_CXX_FLAGS}" STREQUAL "")
  target_compile_options(quadloop_options INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()
set_target_properties(quadloop_options PROPERTIES EXPORT_NAME options)
install(TARGETS quadloop_options EXPORT quadloop COMPONENT dev)

# Where CMAKE_UNITY_BUILD is on (preset `release`), up to so many sources of one target are compiled as one file: headers are read and templates
# instantiated once for all of them. Names in unnamed namespaces must therefore differ within a target.
set(CMAKE_UNITY_BUILD_BATCH_SIZE 24)

# Targets in which meshing spends its time: each source is compiled by itself, as GCC inlines less in large units.
set(QUADLOOP_HOT_MODULES geometry grid delaunay sizes forest snap cut build smoother)

# quadloop_compile_alone(source ...): sources that are compiled by themselves, as they include a library that takes the compiler long.
function(quadloop_compile_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# Everything that `cmake --install` copies: what scripts/quickstart builds.
add_custom_target(installed)

# quadloop_module(NAME SOURCES ... PUBLIC ... PRIVATE ... [COMPONENT name | PROGRAM]): one folder, one library, one idea. It is installed
# as what the door stands on, or as a component that a user of the package asks for, or not at all as only the program needs it.
# Headers are installed by Package.cmake.
function(quadloop_module name)
  cmake_parse_arguments(MODULE "PROGRAM" "COMPONENT" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(quadloop_${name} STATIC ${MODULE_SOURCES})
  add_library(quadloop::${name} ALIAS quadloop_${name})
  target_link_libraries(quadloop_${name} PUBLIC quadloop_options ${MODULE_PUBLIC} PRIVATE ${MODULE_PRIVATE})
  set_target_properties(quadloop_${name} PROPERTIES EXPORT_NAME ${name})
  if(name IN_LIST QUADLOOP_HOT_MODULES)
    set_target_properties(quadloop_${name} PROPERTIES UNITY_BUILD OFF)
  endif()
  if(NOT MODULE_PROGRAM)
    add_dependencies(installed quadloop_${name})
    install(TARGETS quadloop_${name} EXPORT quadloop${MODULE_COMPONENT} ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dev)
  endif()
endfunction()
