#pragma once

#include <optional>
#include <vector>

namespace quadloop::flow {

/// Constants of the run in a solution of the built-in solver, in this order.
struct RunConstants {
  double steps = 0, time = 0, mach = 0;
  double alpha = 0;  ///< degrees
  double cl = 0, cd = 0, residual = 0;

  std::vector<double> values() const { return {steps, time, mach, alpha, cl, cd, residual}; }

  /// Empty if these are not such constants.
  static std::optional<RunConstants> of(const std::vector<double>& c) {
    if (c.size() != 7) return {};
    return RunConstants{c[0], c[1], c[2], c[3], c[4], c[5], c[6]};
  }
};

}  // namespace quadloop::flow
