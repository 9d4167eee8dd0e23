#pragma once

#include <string>
#include <vector>

namespace quadloop {

/// A program with everything that it is given. Paths are absolute.
struct Launch {
  std::string program;
  std::vector<std::string> arguments;    ///< the first is the program's name as it sees it
  std::vector<std::string> environment;  ///< NAME=value
  std::string folder;                    ///< where it works
  std::string log;                       ///< takes its standard output and error
  double timeout = 0;                    ///< seconds, more than 0
};

/// How a program ended.
struct Ending {
  enum class Kind { not_started, status, signal, timed_out, guard_lost };
  Kind kind = Kind::guard_lost;
  int value = 0;  ///< errno, the exit status, or the signal's number
};

/// Runs a program, with an empty standard input, to its end or the end of its time, and ends whatever
/// processes it leaves on this machine (SIGTERM, SIGKILL two seconds later). They end when this process does,
/// too, even by kill -9. The calling thread sleeps meanwhile.
///
/// Between this process and the program stands a guard, a fork that calls nothing but what is safe after a
/// fork of a process with threads. Orphans of the program become its children (PR_SET_CHILD_SUBREAPER), so
/// none escapes by a session of its own. If the guard itself is killed, the kernel kills the program
/// (PR_SET_PDEATHSIG), though not its children.
Ending run_to_its_end(const Launch& launch);

}  // namespace quadloop
