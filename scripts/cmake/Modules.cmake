# One interface target for how every source of ours is compiled.
add_library(quadloop_options INTERFACE)
target_include_directories(quadloop_options INTERFACE "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>"
                                                      "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/quadloop>")
target_compile_features(quadloop_options INTERFACE cxx_std_20)
# Exact predicates, and one result on every machine, need each operation rounded on its own: no fused multiply-add.
target_compile_options(quadloop_options INTERFACE -ffp-contract=off $<BUILD_INTERFACE:-Wall;-Wextra;-Wshadow;-Wconversion>)
option(QUADLOOP_WERROR "warnings are errors (for CI)" OFF)
if(QUADLOOP_WERROR)
  target_compile_options(quadloop_options INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()
set_target_properties(quadloop_options PROPERTIES EXPORT_NAME options)
install(TARGETS quadloop_options EXPORT quadloop)

# quadloop_module(NAME SOURCES ... PUBLIC ... PRIVATE ...): one folder, one library, one idea. It is installed with its headers,
# under the path that an #include names.
function(quadloop_module name)
  cmake_parse_arguments(MODULE "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(quadloop_${name} STATIC ${MODULE_SOURCES})
  add_library(quadloop::${name} ALIAS quadloop_${name})
  target_link_libraries(quadloop_${name} PUBLIC quadloop_options ${MODULE_PUBLIC} PRIVATE ${MODULE_PRIVATE})
  set_target_properties(quadloop_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS quadloop_${name} EXPORT quadloop ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  file(RELATIVE_PATH folder "${PROJECT_SOURCE_DIR}" "${CMAKE_CURRENT_SOURCE_DIR}")
  file(GLOB headers CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.hpp" "${CMAKE_CURRENT_SOURCE_DIR}/*.ipp")
  install(FILES ${headers} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/quadloop/${folder}")
endfunction()
