#pragma once

#include <variant>

#include "adapt/loop/command_solver.hpp"
#include "flow/euler/scheme/euler_options.hpp"

namespace quadloop {

/// The built-in solver or a command, as a case chooses.
using ChosenSolver = std::variant<EulerOptions, CommandSolver>;

}  // namespace quadloop
