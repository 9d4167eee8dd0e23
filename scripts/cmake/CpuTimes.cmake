# Every call of the compiler and of the linker, and every test, appends a row to a file in the build folder: user seconds, system seconds and a name.
# scripts/cpu_times adds them up.
find_program(QUADLOOP_TIME time HINTS /usr/bin)
if(QUADLOOP_TIME)
  execute_process(COMMAND "${QUADLOOP_TIME}" -q -a -o "${PROJECT_BINARY_DIR}/time_works.txt" -f "%U %S %C" true RESULT_VARIABLE failed OUTPUT_QUIET ERROR_QUIET)
  if(failed) # not GNU time
    set(QUADLOOP_TIME "")
  endif()
endif()

# quadloop_timed(VARIABLE FILE NAME): the words that go before a command to measure it, none without GNU time. In NAME `%C` is the command.
function(quadloop_timed variable file name)
  set(words "")
  if(QUADLOOP_TIME)
    set(words "${QUADLOOP_TIME}" -q -a -o "${PROJECT_BINARY_DIR}/${file}" -f "%U %S ${name}")
  endif()
  set(${variable} "${words}" PARENT_SCOPE)
endfunction()
