#include "flow/command/guard.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <ctime>

namespace quadloop {

namespace {

constexpr std::int64_t second = 1'000'000'000;  // nanoseconds
constexpr std::int64_t grace = 2 * second;      // from SIGTERM to SIGKILL
constexpr std::int64_t patience =
    5 * second;  // with processes that even SIGKILL does not end (a file system that hangs)
constexpr std::int64_t between_kills = second / 100;
constexpr int leash_number = 3, report_number = 4;  // after the three standard ones
constexpr int no_such_program = 127;                // as shells have it

std::int64_t now() {
  timespec time = {};
  ::clock_gettime(CLOCK_MONOTONIC, &time);
  return std::int64_t{time.tv_sec} * second + time.tv_nsec;
}

void tell(GuardReport::Kind kind, int value) {
  const GuardReport report{kind, value};
  while (::write(report_number, &report, sizeof report) < 0 && errno == EINTR) {
  }
}

void wake_up(int) {}

/// Handlers and mask are inherited, from quadloop and its launcher: all as a program finds them when a user
/// starts it.
void reset_signals() {
  struct sigaction standard = {};
  standard.sa_handler = SIG_DFL;
  for (int number = 1; number < NSIG; ++number) ::sigaction(number, &standard, nullptr);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

/// SIGCHLD comes through in sleep() alone, so that none is missed between a look and a sleep.
void set_guard_signals() {
  struct sigaction action = {};
  action.sa_handler = SIG_IGN;
  for (const int number : {SIGHUP, SIGINT, SIGQUIT, SIGTERM, SIGPIPE, SIGUSR1, SIGUSR2})
    ::sigaction(number, &action, nullptr);
  action.sa_handler = wake_up;
  ::sigaction(SIGCHLD, &action, nullptr);
  sigset_t children;
  ::sigemptyset(&children);
  ::sigaddset(&children, SIGCHLD);
  ::sigprocmask(SIG_BLOCK, &children, nullptr);
}

/// Descriptors 0 to 2 as the solver gets them, 3 and 4 for the guard, nothing else: MPI's own would look as
/// if quadloop were still alive.
void arrange_descriptors(const GuardedProgram& program, int leash, int report) {
  ::dup2(program.input, STDIN_FILENO);
  ::dup2(program.log, STDOUT_FILENO);
  ::dup2(program.log, STDERR_FILENO);
  ::dup3(leash, leash_number, O_CLOEXEC);
  ::dup3(report, report_number, O_CLOEXEC);
  ::close_range(report_number + 1, ~0U, 0);
}

[[noreturn]] void become_solver(const GuardedProgram& program, pid_t guard_id) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != guard_id) ::_exit(no_such_program);  // it died before it was asked for
  reset_signals();
  if (program.processors != nullptr) ::sched_setaffinity(0, sizeof *program.processors, program.processors);
  ::execve(program.path, program.arguments, program.environment);
  tell(GuardReport::Kind::not_started, errno);
  ::_exit(no_such_program);
}

/// The processes that descend from the solver.
class Tree {
 public:
  explicit Tree(pid_t solver) : solver_{solver} {}

  bool solver_ended() const { return ended_; }
  int status() const { return status_; }

  /// Takes note of the children that have ended. False where none is left.
  bool reap() {
    for (;;) {
      int status = 0;
      const pid_t child = ::waitpid(-1, &status, WNOHANG);
      if (child == 0) return true;
      if (child < 0) return false;
      if (child != solver_) continue;
      ended_ = true;
      status_ = status;
    }
  }

  /// SIGTERM, once for each process: an mpirun that gets a second one leaves without ending its ranks. The
  /// solver's group is sent to while the solver lives, because only so long the group's number is surely its
  /// own.
  void ask_to_end() const {
    if (!ended_)
      ::kill(-solver_, SIGTERM);
    else
      signal_children(SIGTERM);
  }

  /// SIGKILL. Orphans then become our children, for the next turn.
  void kill() const {
    if (!ended_) ::kill(-solver_, SIGKILL);
    signal_children(SIGKILL);
  }

 private:
  /// As many as the first page of the kernel's list holds.
  static void signal_children(int signal_number) {
    std::array<char, 4096> list;
    const int file = ::open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC);
    const ssize_t length = file < 0 ? 0 : ::read(file, list.data(), list.size());
    if (file >= 0) ::close(file);
    pid_t child = 0;
    for (ssize_t i = 0; i < length; ++i) {
      const char c = list[i];
      if (c >= '0' && c <= '9') {
        child = 10 * child + (c - '0');
      } else if (child > 0) {  // each number is followed by a blank
        ::kill(child, signal_number);
        child = 0;
      }
    }
  }

  pid_t solver_;
  bool ended_ = false;
  int status_ = 0;
};

/// Until a child ends, the time is over, or, where asked for, quadloop is gone: then false.
bool sleep(std::int64_t nanoseconds, bool watch_leash) {
  const std::int64_t time = std::max<std::int64_t>(nanoseconds, 0);
  const timespec timeout{static_cast<time_t>(time / second), static_cast<long>(time % second)};
  sigset_t none;
  ::sigemptyset(&none);
  pollfd leash{leash_number, POLLIN, 0};
  return ::ppoll(&leash, watch_leash ? 1 : 0, &timeout, &none) <= 0;
}

void end_tree(Tree& tree) {
  if (!tree.reap()) return;
  tree.ask_to_end();
  for (const std::int64_t end = now() + grace; now() < end;) {
    if (!tree.reap()) return;
    sleep(end - now(), false);
  }
  for (const std::int64_t end = now() + patience; now() < end && tree.reap();) {
    tree.kill();
    sleep(between_kills, false);
  }
}

}  // namespace

void guard(const GuardedProgram& program, int leash, int report) {
  if (::fchdir(program.folder) != 0) ::_exit(no_such_program);
  arrange_descriptors(program, leash, report);
  ::setsid();
  ::prctl(PR_SET_NAME, "solver-guard");  // so that killall quadloop leaves it time for its work
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);
  set_guard_signals();
  const std::int64_t deadline = now() + program.timeout;
  const pid_t guard_id = ::getpid();
  const pid_t solver = ::_Fork();
  if (solver == 0) become_solver(program, guard_id);
  if (solver < 0) {
    tell(GuardReport::Kind::not_started, errno);
    ::_exit(no_such_program);
  }
  ::setpgid(solver, solver);
  tell(GuardReport::Kind::started, solver);
  Tree tree(solver);
  tree.reap();
  while (!tree.solver_ended() && now() < deadline) {
    if (!sleep(deadline - now(), true)) break;
    tree.reap();
  }
  const bool by_itself = tree.solver_ended();
  end_tree(tree);
  tell(by_itself ? GuardReport::Kind::ended : GuardReport::Kind::timed_out, tree.status());
  ::_exit(0);
}

}  // namespace quadloop
