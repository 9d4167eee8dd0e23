#pragma once

#include <algorithm>

#include "flow/euler/residual_watch.hpp"

namespace quadloop::euler {

/// When a steady run tries Newton steps, and with what CFL number: once they are called for, with one that
/// grows threefold as long as whole steps lower the residual and their linear systems are solved. Where
/// shocks still move they fail; then plain steps follow, more after each failure.
class NewtonPilot {
 public:
  /// Whether the next step is to be one.
  bool tries(double residual) {
    if (residual >= developed || !called_) return false;
    if (rest_ == 0) return true;
    --rest_;
    return false;
  }

  /// The flow is near its end, or plain steps bring it no farther.
  void call() { called_ = true; }
  bool is_called() const { return called_; }

  /// The residual is another one, which Newton steps may be good for at once.
  void restart() {
    cfl_ = 0;
    rest_ = 0;
    pause_ = first_pause;
  }

  /// Of that step; `plain` is that of a plain one.
  double cfl(double plain) {
    cfl_ = cfl_ > 0 ? cfl_ : plain;
    return cfl_;
  }

  /// Of the step: which share of the change lowered the residual, and what was left of the linear system's.
  /// Tells whether the step failed.
  bool learn(double share, double left_over) {
    if (share < least_share) {
      cfl_ = std::max(least_cfl, 0.3 * cfl_);
      rest_ = pause_;
      pause_ = std::min(longest_pause, 2 * pause_);
    } else if (left_over > 0.4) {
      cfl_ = std::max(least_cfl, 0.5 * cfl_);
    } else if (share == 1 && left_over < 0.15) {
      cfl_ = std::min(largest_cfl, 3 * cfl_);
    }
    return share < least_share;
  }

 private:
  static constexpr double least_share = 0.5, least_cfl = 10, largest_cfl = 1e9;
  static constexpr int first_pause = 5, longest_pause = 40;
  double cfl_ = 0;  ///< 0: as a plain step's
  bool called_ = false;
  int rest_ = 0, pause_ = first_pause;
};

}  // namespace quadloop::euler
