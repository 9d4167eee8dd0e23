#pragma once

#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::flow {

/// An external flow solver: a program and its arguments, run without a shell.
struct SolverCommand {
  std::vector<std::string> arguments;      ///< with placeholders; the first is the program
  double timeout = 3600;                   ///< seconds
  std::string name = {};                   ///< name in messages; empty: the program
  std::string where = "[solver] command";  ///< location of the setting, for messages
};

/// Files of a cycle's run. All paths are absolute.
struct SolverFiles {
  std::string folder;       ///< the cycle's folder, working directory of the solver
  std::string mesh;         ///< input of the solver
  std::string solution;     ///< output of the solver
  std::string case_folder;  ///< folder of the case file
  int ranks = 1;            ///< number of ranks of the solver, for {ranks}
  int cycle = 0;
  std::string state = {};  ///< file of the initial state, from cycle 1 on; may be the mesh file
};

/// Returns the arguments with {mesh}, {state}, {solution}, {case}, {ranks} and {cycle} replaced. Another name
/// in braces is an InputError; {{name}} becomes {name}. Other braces are unchanged.
std::vector<std::string> filled(const SolverCommand& command, const SolverFiles& files);

/// Returns the file of the solver's standard output and error: solver.log in the cycle's folder.
std::string solver_log(const SolverFiles& files);

/// Returns the message `fault` extended by solver, cycle, log file, and the last line of the log. Also for
/// errors in the solution that it wrote.
std::string solver_message(const SolverCommand& command, const SolverFiles& files, const std::string& fault);

/// Runs the solver once, after removing an old solution: the root starts it and waits for its end, while the
/// other ranks sleep. All processes that it starts on this machine end with it, and with quadloop. Throws
/// InputError if the command is invalid or the program does not exist; SolverError if the solver cannot be
/// started, ends by a signal or with a non-zero status, times out, or its solution file is missing, empty or
/// older than the run. The content of the solution is not checked. *Collective.*
void run_solver(const Communicator& comm, const SolverCommand& command, const SolverFiles& files);

}  // namespace quadloop::flow
