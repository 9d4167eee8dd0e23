#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "flow/euler/steady_parameters.hpp"

namespace quadloop::flow::euler {

/// Detects slow convergence of the residual.
class StallWatch {
 public:
  using Slow = SteadyParameters::Slow;

  void add(double residual) { best_.push_back(best_.empty() ? residual : std::min(best_.back(), residual)); }

  /// Whether the best residual was not reduced to the given fraction in the given number of steps.
  bool is(const Slow& slow) const {
    const auto steps = static_cast<std::size_t>(slow.steps);
    return best_.size() > steps && best_.back() > slow.share * best_[best_.size() - 1 - steps];
  }

  /// Whether the residual did not halve in the second half of all steps, so that more steps will not help.
  bool is_slow() const {
    return std::ssize(best_) > steady_parameters.least_steps && best_.back() > 0.5 * best_[best_.size() / 2];
  }

 private:
  std::vector<double> best_;  ///< best residual up to each step
};

/// Detects a condition that holds for a number of consecutive steps; then the count restarts.
class Patience {
 public:
  explicit Patience(int steps) : steps_{steps} {}

  bool ends(bool is_so) {
    count_ = is_so ? count_ + 1 : 0;
    if (count_ < steps_) return false;
    count_ = 0;
    return true;
  }

 private:
  int steps_, count_ = 0;
};

/// Detects a residual that oscillates without falling: the steps are too large for the flow to settle.
class SwingWatch {
 public:
  bool swings(double residual) {
    constexpr SteadyParameters::Swing swing = steady_parameters.swing;
    const double now = std::log(std::max(residual, least));
    if (steps_ > 0) {
      way_ += std::abs(now - last_);
    } else {
      first_ = now;
    }
    last_ = now;
    lowest_ = std::min(lowest_, now);
    if (++steps_ <= swing.steps) return false;
    const bool swung =
        way_ - std::max(0.0, first_ - now) > swing.path && lowest_ > lowest_before_ - swing.progress;
    lowest_before_ = std::min(lowest_before_, lowest_);
    steps_ = 0;
    way_ = 0;
    lowest_ = std::numeric_limits<double>::infinity();
    return swung;
  }

 private:
  static constexpr double least = 1e-30;
  int steps_ = 0;
  double first_ = 0, last_ = 0, way_ = 0, lowest_ = std::numeric_limits<double>::infinity(),
         lowest_before_ = std::numeric_limits<double>::infinity();
};

/// The fraction of the CFL number that the flow has tolerated so far: small after a setback, then growing to
/// a lower limit than before.
class CflLimit {
 public:
  double share() const { return share_; }
  void lower(double factor) {
    limit_ *= factor;
    share_ = steady_parameters.cfl.restart * limit_;
  }
  void recover() { share_ = std::min(limit_, steady_parameters.cfl.recovery * share_); }

 private:
  double limit_ = 1, share_ = 1;
};

/// The step with the lowest residual.
struct BestFlow {
  int iteration = 0;
  double residual = std::numeric_limits<double>::infinity();
  bool limiter_frozen = false;

  bool improves(int now, double its_residual, bool frozen) {
    if (its_residual >= residual) return false;
    *this = {now, its_residual, frozen};
    return true;
  }

  /// Whether the best flow is to be kept rather than one with this residual. An undeveloped start is not.
  bool keeps(double last) const {
    return last > steady_parameters.setback.clearly_better * residual &&
           (iteration > 0 || residual < steady_parameters.developed);
  }
};

}  // namespace quadloop::flow::euler
