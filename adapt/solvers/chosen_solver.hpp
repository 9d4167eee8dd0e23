#pragma once

#include <variant>

#include "adapt/solvers/command_solver.hpp"
#include "adapt/solvers/openfoam_solver.hpp"
#include "adapt/solvers/su2_solver.hpp"
#include "flow/euler/model/euler_options.hpp"

namespace quadloop::adapt {

/// The solver chosen by a case: built-in, an external command, SU2 or OpenFOAM.
using ChosenSolver = std::variant<flow::EulerOptions, CommandSolver, Su2Solver, OpenfoamSolver>;

/// Returns the external program and its files; null for the built-in solver and for OpenFOAM.
inline const CommandSolver* command_of(const ChosenSolver& solver) {
  if (const auto* su2 = std::get_if<Su2Solver>(&solver)) return &su2->command;
  return std::get_if<CommandSolver>(&solver);
}

}  // namespace quadloop::adapt
