#pragma once

#include <string>
#include <vector>

namespace quadloop::flow {

/// A program with its parameters. Paths are absolute.
struct Launch {
  std::string program;
  std::vector<std::string> arguments;    ///< the first is the program name
  std::vector<std::string> environment;  ///< NAME=value
  std::string folder;                    ///< working directory
  std::string log;                       ///< for its standard output and error
  double timeout = 0;                    ///< in seconds, positive
};

/// Result of a program.
struct Ending {
  enum class Kind { not_started, status, signal, timed_out, guard_lost };
  Kind kind = Kind::guard_lost;
  int value = 0;  ///< errno, the exit status, or the signal's number
};

/// Runs a program, with an empty standard input, until it ends or times out, and ends all processes that it
/// leaves on this machine (SIGTERM, SIGKILL two seconds later). They end with this process too, even by kill
/// -9. The calling thread sleeps meanwhile.
///
/// Between this process and the program is a guard, a fork that makes only calls that are safe after fork in
/// a multi-threaded process. Orphans of the program become its children (PR_SET_CHILD_SUBREAPER), so that
/// none escapes by starting its own session. If the guard itself is killed, the kernel kills the program
/// (PR_SET_PDEATHSIG), but not its children.
Ending run_to_its_end(const Launch& launch);

}  // namespace quadloop::flow
