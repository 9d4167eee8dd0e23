#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

/// The cells between the columns of a fan, row by row. Towards the edge neighbouring columns merge, so that
/// sectors do not get too sharp.
class FanRows {
 public:
  /// Of a fan with rays in these directions (of length 1), and so many rows from the edge to the front.
  FanRows(std::span<const Point> rays, int rows);

  /// The lowest ring that a ray reaches down to: 0 is the edge itself, which all share, `rows` the front. No
  /// less than 1.
  int lowest_ring(std::int32_t ray) const { return lowest_[ray]; }

  /// A cell's corner: a ray, and the ring on it.
  struct Corner {
    std::int32_t ray = 0;
    int ring = 0;
  };
  /// Counter-clockwise where the rays turn clockwise, as those of a wall with the domain to its left; of
  /// three corners or four.
  using Cell = std::vector<Corner>;
  /// The cells that begin at the sector after a ray, from the edge on.
  std::vector<Cell> cells_after(std::int32_t ray) const;

 private:
  std::vector<std::int32_t> rays_at(int ring) const;

  int rows_;
  std::vector<int> lowest_;
};

}  // namespace quadloop
