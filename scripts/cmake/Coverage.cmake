# Preset `coverage`: processes that end by _exit(), as those in which CGNS and trees are read, keep their counts of executed lines too.
option(QUADLOOP_COVERAGE "for scripts/coverage: counts survive _exit()" OFF)
if(QUADLOOP_COVERAGE)
  add_library(quadloop_keep_counts STATIC "${CMAKE_CURRENT_LIST_DIR}/keep_counts.c")
  target_link_libraries(quadloop_options INTERFACE $<BUILD_INTERFACE:quadloop_keep_counts>)
  target_link_options(quadloop_options INTERFACE $<BUILD_INTERFACE:-Wl,--export-dynamic-symbol=_exit>)
endif()
