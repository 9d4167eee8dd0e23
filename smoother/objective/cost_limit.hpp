#pragma once

#include <algorithm>
#include <cmath>

#include "smoother/objective/condition_number.hpp"

namespace quadloop {

/// Tells of most cells, by products alone, that they cost less than a limit (Eq. 3.2 with the ideal targets).
class CostLimit {
 public:
  explicit CostLimit(double limit) : share_{std::max(1 - std::sqrt(limit), 0.0) + margin} {}

  /// Never where cell_cost is the limit or more; may be false of a cell that costs a little less.
  template <std::size_t width>
  bool surely_kept_by(const std::array<Point, width>& cell) const {
    constexpr auto targets = ideal_targets<width>();
    constexpr std::size_t corners = width == 3 ? 1 : width;  // those of a triangle cost the same
    for (std::size_t k = 0; k < corners; ++k) {
      const CornerForm f = corner_form(cell[k], cell[(k + 1) % width], cell[(k + width - 1) % width]);
      if (!(f.jacobian > share_ * weighted_edges(f, targets[k]))) return false;
    }
    return true;
  }

 private:
  static constexpr double margin = 1e-9;  ///< far above what rounding makes of J over the weighted edges
  double share_;
};

}  // namespace quadloop
