#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "flow/command/solver_command.hpp"
#include "flow/euler/scheme/euler_options.hpp"
#include "mesher/mesh/field.hpp"

namespace quadloop {

/// A solver of the user's own, and the files through which it is spoken to, by their names in the cycle's
/// folder.
struct CommandSolver {
  SolverCommand command;
  std::string mesh = "mesh.mesh", solution = "solution.mesh";
  int ranks = 0;  ///< 0: as many as quadloop runs on
  std::string case_folder;
  double gamma = 1.4;  ///< ratio of specific heats of the starting state, where its format wants it

  /// The file that the starting state stands in: that of the mesh where its format has a place for it, else a
  /// .csv beside it.
  std::string state() const;
};

using FlowSolver = std::variant<EulerOptions, CommandSolver>;

/// The ratio of specific heats of the solver's gas.
double gamma_of(const FlowSolver& solver);

/// A flow on a mesh, and what the solver said of it.
struct SolvedFlow {
  Field solution;  ///< a row for each owned node
  std::optional<double> cl, cd, residual;
  std::vector<std::string> notes, warnings;  ///< for the cycle's log; for the user too
};

/// Solves on a mesh whose native file, with the starting state where there is one, stands in the folder
/// already. Throws InputError, SolverError. *Collective.*
SolvedFlow solve_flow(const Communicator& comm, const FlowSolver& solver, const Mesh& mesh,
                      const std::optional<Field>& start, const std::string& folder, int cycle);

}  // namespace quadloop
