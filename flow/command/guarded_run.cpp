#include "flow/command/guarded_run.hpp"

#include <fcntl.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <optional>

#include "flow/command/descriptor.hpp"
#include "flow/command/environment.hpp"
#include "flow/command/guard.hpp"

namespace quadloop {

namespace {

constexpr double longest_timeout = 1e9;  // seconds; its nanoseconds fit into 64 bits

/// The array of pointers that exec wants; it lives as long as the strings.
std::vector<char*> pointers_to(const std::vector<std::string>& strings) {
  std::vector<char*> pointers;
  pointers.reserve(strings.size() + 1);
  for (const std::string& text : strings) pointers.push_back(const_cast<char*>(text.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

/// mpirun binds each rank to a core; a solver that inherited that would have all its threads, and the ranks
/// of its own mpirun, on one. It may run where mpirun may. Nothing where this process was started in another
/// way.
std::optional<cpu_set_t> processors_of_launcher() {
  cpu_set_t processors;
  CPU_ZERO(&processors);
  if (!started_by_mpirun() || ::sched_getaffinity(::getppid(), sizeof processors, &processors) != 0)
    return {};
  return processors;
}

/// False at the end of the pipe.
bool read_report(const Descriptor& pipe, GuardReport& report) {
  for (;;) {
    const ssize_t length = ::read(pipe.number(), &report, sizeof report);
    if (length >= 0 || errno != EINTR)
      return length == static_cast<ssize_t>(sizeof report);  // so short a write comes whole
  }
}

Ending ending_of(int wait_status) {
  if (WIFSIGNALED(wait_status)) return {Ending::Kind::signal, WTERMSIG(wait_status)};
  return {Ending::Kind::status, WEXITSTATUS(wait_status)};
}

/// Sleeps until the guard says how the run ended, or is gone.
Ending awaited_ending(const Descriptor& reports) {
  pid_t solver = 0;
  std::optional<int> reason;
  for (GuardReport report; read_report(reports, report);) {
    switch (report.kind) {
      case GuardReport::Kind::started: solver = report.value; break;
      case GuardReport::Kind::not_started: reason = report.value; break;
      case GuardReport::Kind::timed_out: return {Ending::Kind::timed_out, 0};
      case GuardReport::Kind::ended:
        return reason ? Ending{Ending::Kind::not_started, *reason} : ending_of(report.value);
    }
  }
  if (reason) return {Ending::Kind::not_started, *reason};
  if (solver > 0) ::kill(-solver, SIGKILL);
  return {Ending::Kind::guard_lost, 0};
}

}  // namespace

Ending run_to_its_end(const Launch& launch) {
  const std::vector<char*> arguments = pointers_to(launch.arguments),
                           environment = pointers_to(launch.environment);
  const Descriptor folder = open_descriptor(launch.folder, O_RDONLY | O_DIRECTORY);
  const Descriptor input = open_descriptor("/dev/null", O_RDONLY);
  const Descriptor log = open_descriptor(launch.log, O_WRONLY | O_CREAT | O_TRUNC | O_APPEND);
  const std::optional<cpu_set_t> processors = processors_of_launcher();
  Pipe leash = make_pipe(), reports = make_pipe();
  const GuardedProgram program{
      .path = launch.program.c_str(),
      .arguments = arguments.data(),
      .environment = environment.data(),
      .folder = folder.number(),
      .input = input.number(),
      .log = log.number(),
      .processors = processors ? &*processors : nullptr,
      .timeout = static_cast<std::int64_t>(std::min(launch.timeout, longest_timeout) * 1e9)};
  const pid_t guard_id =
      ::_Fork();  // without the handlers that libraries set for fork(): the child calls none of them
  if (guard_id == 0) guard(program, leash.reading.number(), reports.writing.number());
  if (guard_id < 0) return {Ending::Kind::not_started, errno};
  reports.writing.close();
  const Ending ending = awaited_ending(reports.reading);
  while (::waitpid(guard_id, nullptr, 0) < 0 && errno == EINTR) {
  }
  return ending;
}

}  // namespace quadloop
