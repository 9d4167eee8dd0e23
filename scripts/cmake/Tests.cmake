# How tests are registered. `quick` tests make up the core that runs in a few minutes, `normal` ones belong to every full check,
# `full` ones take long. `sanitize`, beside one of these: run under the sanitizers too, by `scripts/test --full`.
include_guard(GLOBAL)
string(FIND "${CMAKE_CXX_FLAGS}" "-fsanitize=" QUADLOOP_SANITIZED) # -1: no sanitizer
string(REGEX MATCH "-fsanitize=|--coverage" QUADLOOP_SLOW "${CMAKE_CXX_FLAGS}")

# The environment of every test: the same settings that scripts/mpirun gives its users, for programs that run alone too.
set(QUADLOOP_TEST_ENVIRONMENT
    OMPI_ALLOW_RUN_AS_ROOT=1
    OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    OMPI_MCA_rmaps_base_oversubscribe=1
    OMPI_MCA_btl_base_warn_component_unused=0
    OMPI_MCA_btl_vader_single_copy_mechanism=none
    UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1:exitcode=99 # no status of the program's own
    ASAN_OPTIONS=detect_leaks=0:detect_stack_use_after_return=1:exitcode=99:handle_abort=1) # Open MPI keeps memory of its own to the end
set(QUADLOOP_MPIRUN "${PROJECT_SOURCE_DIR}/scripts/mpirun")

# quadloop_add_test(NAME command ...): add_test, with its processor time measured.
function(quadloop_add_test name)
  quadloop_timed(timed test_seconds.txt ${name})
  add_test(NAME ${name} COMMAND ${timed} ${ARGN})
endfunction()

# quadloop_label_test(NAME LABEL quick|normal|full TIMEOUT seconds [SANITIZE]): what every ctest of ours carries.
function(quadloop_label_test name)
  cmake_parse_arguments(TEST "SANITIZE" "LABEL;TIMEOUT" "" ${ARGN})
  if(NOT TEST_LABEL)
    set(TEST_LABEL quick)
  endif()
  if(NOT TEST_TIMEOUT)
    set(TEST_TIMEOUT 120)
  endif()
  if(TEST_SANITIZE)
    list(APPEND TEST_LABEL sanitize)
  endif()
  if(QUADLOOP_SLOW)
    math(EXPR TEST_TIMEOUT "5 * ${TEST_TIMEOUT}")
  endif()
  # The tests with the longest timeouts start first, so that none of them runs alone at the end.
  set_tests_properties(${name} PROPERTIES LABELS "${TEST_LABEL}" TIMEOUT ${TEST_TIMEOUT} COST ${TEST_TIMEOUT}
                                          ENVIRONMENT "${QUADLOOP_TEST_ENVIRONMENT}")
endfunction()

function(quadloop_test_program name)
  cmake_parse_arguments(TEST "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${TEST_SOURCES})
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>) # compiles a quarter faster than -O2; the libraries have that
  target_link_libraries(${name} PRIVATE quadloop_test_support ${TEST_LIBRARIES})
endfunction()

# quadloop_test(NAME SOURCES ... LIBRARIES ... [LABEL normal|full] [TIMEOUT seconds]): a GoogleTest program on one rank; a quick one also
# under sanitizers.
function(quadloop_test name)
  cmake_parse_arguments(TEST "" "LABEL;TIMEOUT" "SOURCES;LIBRARIES" ${ARGN})
  quadloop_test_program(${name} SOURCES ${TEST_SOURCES} LIBRARIES ${TEST_LIBRARIES})
  quadloop_add_test(${name} $<TARGET_FILE:${name}>)
  set(sanitize SANITIZE)
  if(TEST_LABEL)
    set(sanitize "")
  endif()
  quadloop_label_test(${name} LABEL "${TEST_LABEL}" TIMEOUT "${TEST_TIMEOUT}" ${sanitize})
endfunction()

# quadloop_mpi_test(NAME RANKS 1 2 3 ... SOURCES ... LIBRARIES ... [LABEL normal|full] [TIMEOUT seconds]): one ctest NAME.RANKS for
# each number of ranks; the timeout makes a deadlock a failure. Those on one rank and on three are quick, unless there is a LABEL, and
# run under sanitizers too; those on other numbers of ranks are normal.
function(quadloop_mpi_test name)
  cmake_parse_arguments(TEST "" "LABEL;TIMEOUT" "RANKS;SOURCES;LIBRARIES" ${ARGN})
  quadloop_test_program(${name} SOURCES ${TEST_SOURCES} LIBRARIES ${TEST_LIBRARIES})
  foreach(ranks IN LISTS TEST_RANKS)
    quadloop_add_test(${name}.${ranks} "${QUADLOOP_MPIRUN}" -n ${ranks} $<TARGET_FILE:${name}>)
    set(sanitize "")
    set(label "${TEST_LABEL}")
    if(ranks EQUAL 1 OR ranks EQUAL 3)
      set(sanitize SANITIZE)
    elseif(NOT label)
      set(label normal)
    endif()
    quadloop_label_test(${name}.${ranks} LABEL "${label}" TIMEOUT "${TEST_TIMEOUT}" ${sanitize})
    if(ranks GREATER 1)
      set_tests_properties(${name}.${ranks} PROPERTIES PROCESSORS 2) # waiting ranks use their cores
    endif()
  endforeach()
endfunction()
