#pragma once

#include <string>

namespace quadloop {

/// A number that a flow was solved for, and what its mesh does to it by an adjoint solution.
struct GoalValue {
  std::string name;
  double value = 0;
  double corrected = 0;  ///< less the estimated error, with its sign
  double error = 0;      ///< the sum of what all nodes add to that, by size: no error cancels another
  double by_alpha = 0, by_mach = 0;  ///< derivatives, per degree and per unit
  int iterations = 0;                ///< of the adjoint solution
  double residual = 0;               ///< what is left of it
  bool converged = true;             ///< the adjoint solution
};

/// The nodes' shares of the errors, times the goals' weights, as files name them.
inline constexpr const char* error_name = "error";

}  // namespace quadloop
