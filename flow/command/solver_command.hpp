#pragma once

#include <string>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"

namespace quadloop {

/// A flow solver as the user names it: a program and its arguments, run without a shell.
struct SolverCommand {
  std::vector<std::string> arguments;      ///< with placeholders; the first is the program
  double timeout = 3600;                   ///< seconds
  std::string name = {};                   ///< what messages call it; empty: the program
  std::string where = "[solver] command";  ///< where the program is named, for messages
};

/// What a cycle's run works on. All paths are absolute.
struct SolverFiles {
  std::string folder;       ///< the cycle's own folder: the solver is run in it
  std::string mesh;         ///< what the solver reads
  std::string solution;     ///< what it must leave
  std::string case_folder;  ///< where the case file is
  int ranks = 1;            ///< of the solver, for {ranks}
  int cycle = 0;
  std::string state = {};  ///< where the starting state stands, from cycle 1 on; may be that of the mesh
};

/// The arguments with {mesh}, {state}, {solution}, {case}, {ranks} and {cycle} filled in, anywhere in an
/// argument. A name in braces that is none of these is an InputError; {{name}} stands for {name} itself.
/// Other braces stand as they are.
std::vector<std::string> filled(const SolverCommand& command, const SolverFiles& files);

/// Where the solver's standard output and error go: solver.log in the cycle's folder.
std::string solver_log(const SolverFiles& files);

/// The message `fault` with what a user needs to find its cause: which solver and cycle, the log, and the
/// log's last line; the rest stands there. For what is wrong with the solution that it wrote, too.
std::string solver_message(const SolverCommand& command, const SolverFiles& files, const std::string& fault);

/// Runs the solver once, after removing an old solution: the root starts it and waits for its end, and the
/// other ranks sleep meanwhile. All processes that it starts on this machine end with it, and with quadloop.
/// Throws InputError where the command is wrong or there is no such program; SolverError where the solver
/// does not start, ends by a signal or with a status other than 0, does not end in time, or leaves as its
/// solution no file, an empty one or one older than the run. The content of the solution is not looked at.
/// *Collective.*
void run_solver(const Communicator& comm, const SolverCommand& command, const SolverFiles& files);

}  // namespace quadloop
