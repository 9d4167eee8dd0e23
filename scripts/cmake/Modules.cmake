# One interface target for how every source of ours is compiled.
add_library(quadloop_options INTERFACE)
target_include_directories(quadloop_options INTERFACE "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>"
                                                      "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/quadloop>")
target_compile_features(quadloop_options INTERFACE cxx_std_20)
# Exact predicates, and one result on every machine, need each operation rounded on its own: no fused multiply-add.
target_compile_options(quadloop_options INTERFACE -ffp-contract=off $<BUILD_INTERFACE:-Wall;-Wextra;-Wshadow;-Wconversion>)
# GCC gives this warning for types of unnamed namespaces in headers, and takes the sources of one folder for headers.
if(CMAKE_UNITY_BUILD)
  target_compile_options(quadloop_options INTERFACE $<BUILD_INTERFACE:-Wno-subobject-linkage>)
endif()
option(QUADLOOP_WERROR "warnings of GCC 12, the compiler that the tests run with, are errors" OFF)
if(QUADLOOP_WERROR AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION MATCHES "^12\\.")
  target_compile_options(quadloop_options INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()
set_target_properties(quadloop_options PROPERTIES EXPORT_NAME options)
install(TARGETS quadloop_options EXPORT quadloop)

# quadloop_group_sources(TARGET [ALONE source ...]): where CMAKE_UNITY_BUILD is on, the sources of one folder are compiled as one file, so
# that headers are read once for each folder. Names in unnamed namespaces must therefore differ within a folder. Sources after ALONE are
# compiled by themselves: they need flags or pragmas of their own, or take as long as a whole folder.
function(quadloop_group_sources target)
  cmake_parse_arguments(GROUP "" "" "ALONE" ${ARGN})
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    if(NOT source IN_LIST GROUP_ALONE)
      get_filename_component(folder "${CMAKE_CURRENT_SOURCE_DIR}/${source}" DIRECTORY)
      file(RELATIVE_PATH folder "${PROJECT_SOURCE_DIR}" "${folder}")
      string(MAKE_C_IDENTIFIER "${folder}" group)
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
    endif()
  endforeach()
endfunction()

# quadloop_module(NAME SOURCES ... [ALONE ...] PUBLIC ... PRIVATE ... [COMPONENT name | PROGRAM]): one folder, one library, one idea. It is installed
# as what the door stands on, or as a component that a user of the package asks for, or not at all as only the program needs it.
# Headers are installed by Package.cmake.
function(quadloop_module name)
  cmake_parse_arguments(MODULE "PROGRAM" "COMPONENT" "SOURCES;ALONE;PUBLIC;PRIVATE" ${ARGN})
  add_library(quadloop_${name} STATIC ${MODULE_SOURCES} ${MODULE_ALONE})
  quadloop_group_sources(quadloop_${name} ALONE ${MODULE_ALONE})
  add_library(quadloop::${name} ALIAS quadloop_${name})
  target_link_libraries(quadloop_${name} PUBLIC quadloop_options ${MODULE_PUBLIC} PRIVATE ${MODULE_PRIVATE})
  set_target_properties(quadloop_${name} PROPERTIES EXPORT_NAME ${name})
  if(NOT MODULE_PROGRAM)
    install(TARGETS quadloop_${name} EXPORT quadloop${MODULE_COMPONENT} ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  endif()
endfunction()
