#include "flow/command/guarded_run.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>

#include "flow/command/environment.hpp"

namespace quadloop::flow {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto grace = 2s;         // from SIGTERM to SIGKILL
constexpr auto patience = 5s;      // for processes that even SIGKILL does not end (blocked in a file system)
constexpr int between_looks = 10;  // milliseconds
constexpr double longest_wait = 1e6;  // seconds; its milliseconds fit into an int
constexpr int link_number = 3;        // after the three standard descriptors

/// Returns the pointer array for exec; the strings must outlive it.
std::vector<char*> pointers_to(const std::vector<std::string>& strings) {
  std::vector<char*> pointers;
  pointers.reserve(strings.size() + 1);
  for (const std::string& text : strings) pointers.push_back(const_cast<char*>(text.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

/// The process between quadloop and the program, which it starts by fork. The other end of `link` is closed
/// when quadloop ends.
class Guard {
 public:
  Guard(const Launch& launch, int link)
      : launch_{launch},
        arguments_{pointers_to(launch.arguments)},
        environment_{pointers_to(launch.environment)},
        link_{link} {}

  [[noreturn]] void live() {
    hold_signals();
    ::setsid();
    ::prctl(PR_SET_NAME, "solver-guard");  // so that killall quadloop does not kill it before it has finished
    ::prctl(PR_SET_CHILD_SUBREAPER, 1);
    arrange_descriptors();
    follow_launcher();
    const pid_t guard_id = ::getpid();
    solver_ = ::_Fork();
    if (solver_ == 0) become_solver(guard_id);
    if (solver_ < 0) give_up();
    ::setpgid(solver_, solver_);
    const bool by_itself = wait();
    end_tree();
    if (!by_itself)
      tell({Ending::Kind::timed_out, 0});
    else if (WIFSIGNALED(status_))
      tell({Ending::Kind::signal, WTERMSIG(status_)});
    else
      tell({Ending::Kind::status, WEXITSTATUS(status_)});
    ::_exit(0);
  }

 private:
  static void tell(const Ending& ending) { ::send(link_number, &ending, sizeof ending, MSG_NOSIGNAL); }

  [[noreturn]] static void give_up() {
    tell({Ending::Kind::not_started, errno});
    ::_exit(127);
  }

  /// Signals of a terminal and a launcher are meant for quadloop. The program has the default handlers, as
  /// when started by a user.
  static void hold_signals() {
    sigset_t all;
    ::sigfillset(&all);
    ::sigprocmask(SIG_BLOCK, &all, nullptr);
    struct sigaction standard = {};
    standard.sa_handler = SIG_DFL;
    for (int number = 1; number < NSIG; ++number) ::sigaction(number, &standard, nullptr);
  }

  /// Sets descriptors 0 to 2 for the program, and the link, and closes all others: those of MPI would look as
  /// if quadloop were still running.
  void arrange_descriptors() const {
    const int link = ::fcntl(link_, F_DUPFD_CLOEXEC, 10);
    ::dup2(::open("/dev/null", O_RDONLY), STDIN_FILENO);
    const int log = ::open(launch_.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0666);
    const int fault = errno;
    ::dup2(log, STDOUT_FILENO);
    ::dup2(log, STDERR_FILENO);
    ::dup3(link, link_number, O_CLOEXEC);
    ::close_range(link_number + 1, ~0U, 0);
    errno = fault;
    if (log < 0 || ::chdir(launch_.folder.c_str()) != 0) give_up();
  }

  /// mpirun binds each rank to a core; all threads of the program, and the ranks of its own mpirun, would
  /// inherit this. It may run on the cores available to mpirun.
  void follow_launcher() const {
    cpu_set_t processors;
    if (launcher_ > 0 && ::sched_getaffinity(launcher_, sizeof processors, &processors) == 0)
      ::sched_setaffinity(0, sizeof processors, &processors);
  }

  [[noreturn]] void become_solver(pid_t guard_id) {
    ::setpgid(0, 0);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != guard_id) ::_exit(127);  // the parent died before the request
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    ::execve(launch_.program.c_str(), arguments_.data(), environment_.data());
    give_up();
  }

  /// Waits for the program; returns false if it times out, or quadloop has ended.
  bool wait() {
    const auto deadline = Clock::now() + std::chrono::duration<double>(launch_.timeout);
    sigset_t children;
    ::sigemptyset(&children);
    ::sigaddset(&children, SIGCHLD);
    const int ends = ::signalfd(-1, &children, SFD_CLOEXEC);
    std::array<pollfd, 2> events{{{ends, POLLIN, 0}, {link_number, POLLIN, 0}}};
    while (true) {
      reap();
      const std::chrono::duration<double> left = deadline - Clock::now();
      if (ended_ || events[1].revents != 0 || left.count() <= 0) return ended_;
      ::poll(events.data(), events.size(), static_cast<int>(1e3 * std::min(left.count(), longest_wait)) + 1);
      signalfd_siginfo end;
      if (events[0].revents != 0 && ::read(ends, &end, sizeof end) < 0) return false;
    }
  }

  /// Collects the children that have ended. Returns false if none is left.
  bool reap() {
    while (true) {
      int status = 0;
      const pid_t child = ::waitpid(-1, &status, WNOHANG);
      if (child <= 0) return child == 0;
      if (child != solver_) continue;
      ended_ = true;
      status_ = status;
    }
  }

  /// Each process gets SIGTERM once: an mpirun that gets a second one exits without ending its ranks. The
  /// program's group gets the signal while the program lives, as only then the group number is certainly its
  /// own. Each SIGKILL makes orphans our children, for the next iteration.
  void end_tree() {
    if (!reap()) return;
    if (ended_)
      signal_children(SIGTERM);
    else
      ::kill(-solver_, SIGTERM);
    for (const auto end = Clock::now() + grace; Clock::now() < end; ::poll(nullptr, 0, between_looks)) {
      if (!reap()) return;
    }
    for (const auto end = Clock::now() + patience; Clock::now() < end && reap();
         ::poll(nullptr, 0, between_looks)) {
      if (!ended_) ::kill(-solver_, SIGKILL);
      signal_children(SIGKILL);
    }
  }

  /// Limited to the first page of the kernel's list.
  static void signal_children(int signal_number) {
    std::array<char, 4096> list{};
    const int file = ::open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC);
    const ssize_t length = ::read(file, list.data(), list.size() - 1);
    ::close(file);
    char* next = list.data();
    for (long child; length > 0 && (child = std::strtol(next, &next, 10)) > 0;)
      ::kill(static_cast<pid_t>(child), signal_number);
  }

  const Launch& launch_;
  std::vector<char*> arguments_, environment_;
  int link_;
  pid_t launcher_ = started_by_mpirun() ? ::getppid() : 0;
  pid_t solver_ = 0;
  bool ended_ = false;
  int status_ = 0;
};

}  // namespace

Ending run_to_its_end(const Launch& launch) {
  std::array<int, 2> link{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, link.data()) != 0)
    return {Ending::Kind::not_started, errno};
  Guard guard(launch, link[1]);
  const pid_t guard_id = ::_Fork();  // without the handlers that libraries set for fork()
  if (guard_id == 0) guard.live();
  const int fault = errno;
  ::close(link[1]);
  Ending ending;
  ssize_t length = 0;
  while (guard_id > 0 && (length = ::recv(link[0], &ending, sizeof ending, 0)) < 0 && errno == EINTR) {
  }
  while (guard_id > 0 && ::waitpid(guard_id, nullptr, 0) < 0 && errno == EINTR) {
  }
  ::close(link[0]);
  if (guard_id < 0) return {Ending::Kind::not_started, fault};
  return length == sizeof ending ? ending : Ending{};
}

}  // namespace quadloop::flow
