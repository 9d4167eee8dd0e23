#pragma once

#include <variant>

#include "adapt/loop/command_solver.hpp"
#include "adapt/loop/openfoam_solver.hpp"
#include "flow/euler/scheme/euler_options.hpp"

namespace quadloop {

/// The built-in solver, a command, or a case of OpenFOAM's, as a case chooses.
using ChosenSolver = std::variant<EulerOptions, CommandSolver, OpenfoamSolver>;

}  // namespace quadloop
