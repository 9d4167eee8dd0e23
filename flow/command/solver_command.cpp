#include "flow/command/solver_command.hpp"

#include <sys/stat.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <tuple>

#include "flow/command/environment.hpp"
#include "flow/command/guarded_run.hpp"
#include "flow/command/log_tail.hpp"
#include "flow/command/program.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/shared_stage.hpp"

namespace quadloop::flow {

namespace {

std::string search_path() {
  const char* path = std::getenv("PATH");
  return path != nullptr ? path : "/usr/local/bin:/usr/bin:/bin";
}

Launch launch_of(const SolverCommand& command, const SolverFiles& files) {
  QUADLOOP_REQUIRE(std::filesystem::path(files.folder).is_absolute(),
                   "the folder of a solver's run is not absolute");
  if (!(command.timeout > 0)) throw InputError("[solver] timeout must be more than 0 seconds");
  Launch launch;
  launch.arguments = filled(command, files);
  launch.program = find_program(launch.arguments.front(), search_path(), files.folder, command.where);
  launch.environment = environment_for(files.folder, files.ranks);
  launch.folder = files.folder;
  launch.log = solver_log(files);
  launch.timeout = command.timeout;
  return launch;
}

void remove_old_file(const std::string& path) {
  std::error_code fault;
  if (std::filesystem::is_directory(std::filesystem::symlink_status(path, fault)))
    throw InputError(path + ": is a folder, but the solver writes a file of that name; move the folder away");
  std::filesystem::remove(path, fault);
  if (fault)
    throw OutputError(path + ": the old file cannot be removed: " + fault.message() + "; remove it by hand");
}

/// Returns the state of the path after following links; a mode of 0 if it does not exist.
struct stat state_of(const std::string& path) {
  struct stat state = {};
  if (::stat(path.c_str(), &state) != 0) state = {};
  return state;
}

/// Removes an earlier solution that could be taken for that of this run, and creates the log. Returns its
/// state, whose time is the start of the run by the clock of the file system, which may be on another
/// machine.
struct stat begin_run(const SolverFiles& files) {
  const auto normal = [](const std::string& path) { return std::filesystem::path(path).lexically_normal(); };
  if (normal(files.solution) == normal(files.mesh))
    throw InputError("[solver] mesh and solution have the same name, " + files.solution +
                     "; give the solution another name");
  remove_old_file(files.solution);
  remove_old_file(solver_log(files));
  if (!std::ofstream(solver_log(files)))
    throw OutputError(solver_log(files) + ": cannot be opened: " + std::strerror(errno) +
                      "; the solver needs it");
  return state_of(solver_log(files));
}

[[noreturn]] void fail(const SolverCommand& command, const SolverFiles& files, const std::string& fault) {
  throw SolverError(solver_message(command, files, fault));
}

std::string time_fault(double timeout) {
  std::ostringstream text;
  text << "had not ended after " << timeout
       << " s and was stopped (increase [solver] timeout if it needs longer)";
  return text.str();
}

std::string signal_fault(int number) {
  const std::string text =
      "was killed by signal " + std::to_string(number) + " (" + ::strsignal(number) + ")";
  return number == SIGKILL ? text + ", by a user or because memory ran out" : text;
}

std::string start_fault(int reason) {
  std::string text = std::string("cannot be started: ") + std::strerror(reason);
  if (reason == ENOEXEC) text += " (a script must begin with a line as #!/bin/sh)";
  if (reason == ENOENT) text += " (the interpreter that its first line names is missing)";
  return text;
}

/// Empty if the run succeeded.
std::string fault_of(const Ending& ending, double timeout) {
  switch (ending.kind) {
    case Ending::Kind::status:
      return ending.value == 0 ? "" : "ended with exit status " + std::to_string(ending.value);
    case Ending::Kind::signal: return signal_fault(ending.value);
    case Ending::Kind::timed_out: return time_fault(timeout);
    case Ending::Kind::not_started: return start_fault(ending.value);
    case Ending::Kind::guard_lost: break;
  }
  return "was killed, because the process that supervises it was";
}

/// Empty if there is a file that may contain a solution of this run.
std::string solution_fault(const std::string& path, const struct stat& begin) {
  const struct stat state = state_of(path);
  if (state.st_mode == 0) return "ended without leaving its solution, " + path;
  if (!S_ISREG(state.st_mode)) return "left something that is no file as its solution, " + path;
  if (state.st_size == 0) return "left an empty solution, " + path;
  const auto stamp = [](const struct stat& file) {
    return std::tuple(file.st_mtim.tv_sec, file.st_mtim.tv_nsec);
  };
  const bool one_clock = state.st_dev == begin.st_dev;
  if (one_clock && stamp(state) < stamp(begin))
    return "left a file older than its run as its solution, " + path;
  return {};
}

/// On one rank.
void run_here(const SolverCommand& command, const SolverFiles& files) {
  const Launch launch = launch_of(command, files);
  const struct stat begin = begin_run(files);
  const Ending ending = run_to_its_end(launch);
  if (const std::string fault = fault_of(ending, command.timeout); !fault.empty())
    fail(command, files, fault);
  if (const std::string fault = solution_fault(files.solution, begin); !fault.empty())
    fail(command, files, fault);
}

}  // namespace

std::string solver_log(const SolverFiles& files) {
  return std::filesystem::path(files.folder) / "solver.log";
}

std::string solver_message(const SolverCommand& command, const SolverFiles& files, const std::string& fault) {
  const std::string first = command.arguments.empty() ? "" : command.arguments.front();
  const std::string& program = command.name.empty() ? first : command.name;
  const std::string message =
      "the solver '" + program + "' of cycle " + std::to_string(files.cycle) + " " + fault + "; ";
  if (const std::string cause = reported_error(solver_log(files)); !cause.empty())
    return message + solver_log(files) + " has: " + cause;
  const std::string last = last_line(solver_log(files));
  if (last.empty()) return message + "it wrote nothing to its log, " + solver_log(files);
  return message + solver_log(files) + " ends: " + last;
}

void run_solver(const Communicator& comm, const SolverCommand& command, const SolverFiles& files) {
  std::exception_ptr outcome;
  const progress::SharedStage stage(comm, "the solver runs");
  try {
    if (comm.is_root()) run_here(command, files);
  } catch (...) {
    outcome = std::current_exception();
  }
  comm.patient_barrier();  // until here the processors are free for the solver
  comm.together([&] {
    if (outcome) std::rethrow_exception(outcome);
  });
}

}  // namespace quadloop::flow
