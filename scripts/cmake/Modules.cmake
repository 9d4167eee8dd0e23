# One interface target for how every source of ours is compiled.
add_library(quadloop_options INTERFACE)
target_include_directories(quadloop_options INTERFACE "${PROJECT_SOURCE_DIR}")
target_compile_features(quadloop_options INTERFACE cxx_std_20)
# Exact predicates, and one result on every machine, need each operation rounded on its own: no fused multiply-add.
target_compile_options(quadloop_options INTERFACE -ffp-contract=off -Wall -Wextra -Wshadow -Wconversion)
option(QUADLOOP_WERROR "warnings are errors (for CI)" OFF)
if(QUADLOOP_WERROR)
  target_compile_options(quadloop_options INTERFACE -Werror)
endif()

# quadloop_module(NAME SOURCES ... PUBLIC ... PRIVATE ...): one folder, one library, one idea.
function(quadloop_module name)
  cmake_parse_arguments(MODULE "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(quadloop_${name} STATIC ${MODULE_SOURCES})
  add_library(quadloop::${name} ALIAS quadloop_${name})
  target_link_libraries(quadloop_${name} PUBLIC quadloop_options ${MODULE_PUBLIC} PRIVATE ${MODULE_PRIVATE})
endfunction()
