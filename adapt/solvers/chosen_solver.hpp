#pragma once

#include <variant>

#include "adapt/solvers/command_solver.hpp"
#include "adapt/solvers/openfoam_solver.hpp"
#include "adapt/solvers/su2_solver.hpp"
#include "flow/euler/model/euler_options.hpp"

namespace quadloop {

/// The built-in solver, a command, SU2 or a case of OpenFOAM's, as a case chooses.
using ChosenSolver = std::variant<EulerOptions, CommandSolver, Su2Solver, OpenfoamSolver>;

/// The program of the user's that is run, and its files; null for
/// the built-in solver and for OpenFOAM.
inline const CommandSolver* command_of(const ChosenSolver& solver) {
  if (const auto* su2 = std::get_if<Su2Solver>(&solver)) return &su2->command;
  return std::get_if<CommandSolver>(&solver);
}

}  // namespace quadloop
