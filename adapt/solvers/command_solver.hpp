#pragma once

#include <functional>
#include <string>

#include "adapt/solvers/cycle_paths.hpp"
#include "flow/command/solver_command.hpp"
#include "flow/flow_solver.hpp"

namespace quadloop::adapt {

/// An external solver, with the names of its files in the cycle's folder.
struct CommandSolver {
  flow::SolverCommand command;
  std::string mesh = CyclePaths::mesh_name(io::native_format().name),
              solution = "solution." + io::native_format().name;
  int ranks = 0;  ///< 0: as many as quadloop uses
  std::string case_folder;
  double gamma = 1.4;  ///< ratio of specific heats of the initial state, if its format needs it

  /// Returns the file of the initial state: the mesh file if its format can store a state, else a separate
  /// file, in the solution's format if that stores states without a mesh, or .csv.
  std::string state() const;
};

/// Returns the command as a solver. It runs in folder_of(cycle), where native_mesh() must already exist, with
/// the initial state if there is one. Throws SolverError if the command fails or its solution is unusable.
flow::FlowSolver command_solver(CommandSolver solver, std::function<std::string(int cycle)> folder_of);

}  // namespace quadloop::adapt
