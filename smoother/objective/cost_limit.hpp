#pragma once

#include <algorithm>
#include <cmath>

#include "smoother/objective/condition_number.hpp"

namespace quadloop::smoother {

/// Decides for most cells, without divisions and roots, whether their cost is below or above a limit (Eq. 3.2
/// with ideal targets).
class CostLimit {
 public:
  explicit CostLimit(double limit) : share_{std::max(1 - std::sqrt(limit), 0.0)} {}

  /// True only if cell_cost is below the limit; may be false for a cell slightly below it.
  template <std::size_t width>
  bool surely_kept_by(const std::array<Point, width>& cell) const {
    for (std::size_t k = 0; k < corners<width>; ++k) {
      if (!is_above(share_ + margin, cell, k)) return false;
    }
    return true;
  }
  /// True only if cell_cost is above the limit, which is under 1; may be false for a cell slightly above it.
  template <std::size_t width>
  bool surely_missed_by(const std::array<Point, width>& cell) const {
    for (std::size_t k = 0; k < corners<width>; ++k) {
      if (!is_above(share_ - margin, cell, k)) return true;
    }
    return false;
  }

 private:
  static constexpr double margin = 1e-9;  ///< far above the rounding error of J over the weighted edges
  template <std::size_t width>
  /// Number of corners to test: the three of a triangle have the same cost.
  static constexpr std::size_t corners = width == 3 ? 1 : width;
  /// Whether J of the k-th corner exceeds the fraction `share` of the weighted edges.
  template <std::size_t width>
  static bool is_above(double share, const std::array<Point, width>& cell, std::size_t k) {
    constexpr auto targets = ideal_targets<width>();
    const CornerForm f = corner_form(cell[k], cell[(k + 1) % width], cell[(k + width - 1) % width]);
    return f.jacobian > share * weighted_edges(f, targets[k]);
  }
  double share_;
};

}  // namespace quadloop::smoother
