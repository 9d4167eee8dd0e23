#pragma once

#include <sched.h>

#include <cstdint>

namespace quadloop {

/// A program to run, made ready before the fork: nothing is allocated after it. Descriptors are 10 or more.
struct GuardedProgram {
  const char* path = nullptr;
  char* const* arguments = nullptr;    ///< with a null pointer at the end
  char* const* environment = nullptr;  ///< likewise
  int folder = -1, input = -1, log = -1;
  const cpu_set_t* processors = nullptr;  ///< where the program may run; null: as this process
  std::int64_t timeout = 0;               ///< nanoseconds
};

/// What the guard tells quadloop: `started` (value: the process id), then, after `not_started` (errno) where
/// that was so, one of the others.
struct GuardReport {
  enum class Kind : int { started, not_started, ended, timed_out };
  Kind kind = Kind::ended;
  int value = 0;  ///< of `ended`: the status as waitpid gives it
};

/// The life of the guard, a process forked from quadloop that stands between it and the solver: starts the
/// program, waits until it ends, its time is over or quadloop is gone (the pipe `leash`, which nobody writes
/// to, is closed at its other end), then ends every process that descends from the program and is on this
/// machine (SIGTERM, SIGKILL two seconds later), and reports on `report`.
///
/// It calls nothing but what is safe after a fork of a process with threads. It has a session of its own, and
/// ignores what a terminal or a launcher sends to quadloop; orphans of the solver become its children, so
/// none escapes by a session or process group of its own. If the guard itself is killed, the kernel kills the
/// solver (PR_SET_PDEATHSIG; the guard has one thread, so it is the process that counts), though not its
/// children.
[[noreturn]] void guard(const GuardedProgram& program, int leash, int report);

}  // namespace quadloop
