#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace quadloop::euler {

/// A relative residual below which a flow has its shape: what comes later is no transient of the start.
constexpr double developed = 0.05;

/// Tells when the residual falls slowly, as it does where the limiter's factors swing to and fro, or would if
/// steps there were not small.
class StallWatch {
 public:
  bool stalls(double residual) {
    best_.push_back(best_.empty() ? residual : std::min(best_.back(), residual));
    return (residual < developed && falls_less(30, 0.5)) || (residual < near && falls_less(10, 0.7)) ||
           (residual < settled && falls_less(10, 0.4));
  }

  /// The residual of a flow that has its shape did not halve in a hundred steps.
  bool rests() const { return best_.back() < developed && falls_less(100, 0.5); }

  /// The residual did not halve in five hundred steps.
  bool is_over() const { return falls_less(500, 0.5); }

  /// So near the end that the limiter's factors are all but those of the end.
  static bool is_settled(double residual) { return residual < settled; }

  /// In the second half of all steps the residual did not halve: more of them are no cure.
  bool is_slow() const { return best_.size() > 60 && best_.back() > 0.5 * best_[best_.size() / 2]; }

 private:
  /// Below these the flow is near the end, so that factors that are kept are nearly those of the end.
  static constexpr double near = 0.02, settled = 3e-3;

  /// The best is not down to that share of what it was so many steps ago.
  bool falls_less(std::size_t window, double share) const {
    return best_.size() > window && best_.back() > share * best_[best_.size() - 1 - window];
  }

  std::vector<double> best_;  ///< up to each step
};

/// Tells when the residual of a developed flow has long been well above the best.
class RiseWatch {
 public:
  bool rises(double residual, double best) {
    steps_ = best < developed && residual > factor * best ? steps_ + 1 : 0;
    if (steps_ < patience) return false;
    steps_ = 0;
    return true;
  }

 private:
  static constexpr double factor = 10;
  static constexpr int patience = 20;
  int steps_ = 0;
};

/// Tells when the residual goes to and fro and does not fall: steps are too large for the flow to settle.
/// A transient's residual does not fall for long either, but changes little from step to step.
class SwingWatch {
 public:
  bool swings(double residual) {
    const double now = std::log(std::max(residual, least));
    if (steps_ > 0) {
      way_ += std::abs(now - last_);
    } else {
      first_ = now;
    }
    last_ = now;
    lowest_ = std::min(lowest_, now);
    if (++steps_ <= window) return false;
    const bool swung = way_ - std::max(0.0, first_ - now) > to_and_fro && lowest_ > lowest_before_ - fall;
    lowest_before_ = std::min(lowest_before_, lowest_);
    steps_ = 0;
    way_ = 0;
    lowest_ = std::numeric_limits<double>::infinity();
    return swung;
  }

 private:
  static constexpr int window = 40;
  static constexpr double to_and_fro = 3;  ///< of the logarithm, over the window
  static constexpr double fall = 0.5;      ///< of it, that is progress all the same
  static constexpr double least = 1e-30;
  int steps_ = 0;
  double first_ = 0, last_ = 0, way_ = 0, lowest_ = std::numeric_limits<double>::infinity(),
         lowest_before_ = std::numeric_limits<double>::infinity();
};

/// Tells when the residual has the same bits step after step: changes are not finite, or so large that no
/// node can bear any of them.
class StandstillWatch {
 public:
  bool stands(double residual) {
    steps_ = residual == last_ ? steps_ + 1 : 0;
    last_ = residual;
    if (steps_ < patience) return false;
    steps_ = 0;
    return true;
  }

 private:
  static constexpr int patience = 3;
  int steps_ = 0;
  double last_ = -1;
};

/// The share of the CFL number that a flow has borne out so far: small after it went wrong, then growing to a
/// limit that is lower than before.
class CflLimit {
 public:
  double share() const { return share_; }
  void lower(double factor) {
    limit_ *= factor;
    share_ = 0.2 * limit_;
  }
  void recover() { share_ = std::min(limit_, 1.05 * share_); }

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

  /// Whether it is to be kept rather than a flow with this residual. A start that is no developed flow is
  /// not.
  bool keeps(double last) const { return last > 2 * residual && (iteration > 0 || residual < developed); }
};

}  // namespace quadloop::euler
