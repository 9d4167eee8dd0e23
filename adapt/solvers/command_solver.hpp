#pragma once

#include <functional>
#include <string>

#include "adapt/solvers/cycle_paths.hpp"
#include "flow/command/solver_command.hpp"
#include "flow/flow_solver.hpp"

namespace quadloop {

/// A solver of the user's own, and the files through which it is spoken to, by their names in the cycle's
/// folder.
struct CommandSolver {
  SolverCommand command;
  std::string mesh = CyclePaths::mesh_name(native_format().name),
              solution = "solution." + native_format().name;
  int ranks = 0;  ///< 0: as many as quadloop runs on
  std::string case_folder;
  double gamma = 1.4;  ///< ratio of specific heats of the starting state, where its format wants it

  /// The file that the starting state stands in: that of the mesh where its format has a place for it, else
  /// one beside it that holds nothing else, of the solution's format where that is such a one, or a .csv.
  std::string state() const;
};

/// The command as any other solver. Where it solves, folder_of(cycle), the mesh must stand in its
/// native_mesh() already, with the starting state where there is one. Throws SolverError for what the command
/// does or leaves.
FlowSolver command_solver(CommandSolver solver, std::function<std::string(int cycle)> folder_of);

}  // namespace quadloop
