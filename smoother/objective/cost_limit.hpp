#pragma once

#include <algorithm>
#include <cmath>

#include "smoother/objective/condition_number.hpp"

namespace quadloop {

/// Tells of most cells, by products alone, whether they cost less than a limit or more (Eq. 3.2 with the
/// ideal targets).
class CostLimit {
 public:
  explicit CostLimit(double limit) : share_{std::max(1 - std::sqrt(limit), 0.0)} {}

  /// Never where cell_cost is the limit or more; may be false of a cell that costs a little less.
  template <std::size_t width>
  bool surely_kept_by(const std::array<Point, width>& cell) const {
    for (std::size_t k = 0; k < corners<width>; ++k) {
      if (!is_above(share_ + margin, cell, k)) return false;
    }
    return true;
  }
  /// Never where cell_cost is the limit, under 1, or less; may be false of a cell that costs a little more.
  template <std::size_t width>
  bool surely_missed_by(const std::array<Point, width>& cell) const {
    for (std::size_t k = 0; k < corners<width>; ++k) {
      if (!is_above(share_ - margin, cell, k)) return true;
    }
    return false;
  }

 private:
  static constexpr double margin = 1e-9;  ///< far above what rounding makes of J over the weighted edges
  template <std::size_t width>
  static constexpr std::size_t corners = width == 3 ? 1 : width;  ///< those of a triangle cost the same
  /// Whether J of the k-th corner is above that share of the weighted edges.
  template <std::size_t width>
  static bool is_above(double share, const std::array<Point, width>& cell, std::size_t k) {
    constexpr auto targets = ideal_targets<width>();
    const CornerForm f = corner_form(cell[k], cell[(k + 1) % width], cell[(k + width - 1) % width]);
    return f.jacobian > share * weighted_edges(f, targets[k]);
  }
  double share_;
};

}  // namespace quadloop
