#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A hash table of points by their coordinates.
class PointTable {
 public:
  /// `points` must outlive it.
  explicit PointTable(std::span<const Point> points);

  /// The index of a point with the same coordinates, the first of several; -1 if there is none.
  std::int32_t find(Point p) const { return slots_[slot_of(p)]; }
  /// Whether any two of the points have the same coordinates.
  bool any_twice() const { return any_twice_; }

 private:
  std::size_t slot_of(Point p) const;

  std::span<const Point> points_;
  std::vector<std::int32_t> slots_;  ///< open addressing, at most half full
  bool any_twice_ = false;
};

/// For each of `points` the index of one of the `known` points with the same coordinates, the first of
/// several; -1 if there is none. O(n + m).
std::vector<std::int32_t> find_equal_points(std::span<const Point> known, std::span<const Point> points);

}  // namespace quadloop
