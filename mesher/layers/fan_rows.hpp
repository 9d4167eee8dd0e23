#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

/// The cells between the columns of a fan, row by row. Neighbouring columns merge towards the sharp corner,
/// so that sectors do not get too sharp.
class FanRows {
 public:
  /// A fan with rays in these unit directions and this number of rows from the corner to the front.
  FanRows(std::span<const Point> rays, int rows);

  /// The lowest ring that a ray reaches, at least 1. Ring 0 is the corner, shared by all rays; ring `rows` is
  /// the front.
  int lowest_ring(std::int32_t ray) const { return lowest_[ray]; }

  /// A corner of a cell: a ray and a ring on it.
  struct Corner {
    std::int32_t ray = 0;
    int ring = 0;
  };
  /// Three or four corners, counter-clockwise if the rays turn clockwise (a wall with the domain to its
  /// left).
  using Cell = std::vector<Corner>;
  /// The cells that begin at the sector after a ray, from the corner outwards.
  std::vector<Cell> cells_after(std::int32_t ray) const;

 private:
  std::vector<std::int32_t> rays_at(int ring) const;

  int rows_;
  std::vector<int> lowest_;
};

}  // namespace quadloop
