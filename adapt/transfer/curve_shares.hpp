#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/base/communicator.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

/// The plane in one piece for each rank: stretches of a Morton curve with about equally many of the points given. Who has what depends on the
/// number of ranks; nothing of a result may.
class CurveShares {
 public:
  /// `points` are this rank's; the first list gives the box. *Collective.*
  CurveShares(const Communicator& comm, std::span<const Point> in_box, std::span<const Point> more);

  /// The rank whose piece holds a point; one outside the box counts as the nearest one of its rim.
  int rank_of(Point p) const { return rank_of_key(key_of(p)); }

  /// The ranks whose pieces meet a box, ascending, in a list that is used again.
  void ranks_meeting(const Box& box, std::vector<int>& ranks) const;

 private:
  struct Corner {
    std::uint32_t x = 0, y = 0;
  };
  struct Corners {
    Corner low, high;
  };

  Corner corner_of(Point p) const;
  std::uint64_t key_of(Point p) const;
  int rank_of_key(std::uint64_t key) const;
  void set_box(const Communicator& comm, std::span<const Point> points);
  void set_splits(const Communicator& comm, std::span<const Point> points, std::span<const Point> more);
  void descend(const Corners& box, Corner cell, int bits, std::vector<int>& ranks) const;

  Point low_;
  double scale_ = 0;                   ///< steps of the curve in a unit of length
  std::vector<std::uint64_t> splits_;  ///< the first key of each rank but the first
};

}  // namespace quadloop
