#pragma once

#include <string>

namespace quadloop::flow {

/// Value of an output functional, with its error estimate from an adjoint solution.
struct GoalValue {
  std::string name;
  double value = 0;
  double corrected = 0;  ///< value minus the signed error estimate
  double error = 0;      ///< sum of the absolute nodal contributions to that error, without cancellation
  double by_alpha = 0, by_mach = 0;  ///< derivatives with respect to alpha (per degree) and Mach number
  int iterations = 0;                ///< of the adjoint solution
  double residual = 0;               ///< of the adjoint solution, after the last iteration
  bool converged = true;             ///< whether the adjoint solution has converged
};

/// Name in files of the nodal error contributions, weighted by the functionals' weights.
inline constexpr const char* error_name = "error";

}  // namespace quadloop::flow
