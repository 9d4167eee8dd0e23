#pragma once

#include <cstdint>
#include <vector>

#include "mesher/geometry/outline.hpp"

namespace quadloop {

/// The points of all loops in one array, with successor relations. A segment has the number of its first
/// point.
struct FlatOutline {
  explicit FlatOutline(const Outline& outline);

  std::vector<Point> points;
  std::vector<std::int32_t> loop_of, loop_starts;

  std::size_t loop_count() const { return loop_starts.size() - 1; }
  std::size_t loop(std::int32_t v) const { return loop_of[v]; }
  Point point(std::int32_t v) const { return points[v]; }
  std::int32_t next(std::int32_t v) const {
    return v + 1 < loop_starts[loop(v) + 1] ? v + 1 : loop_starts[loop(v)];
  }
  std::int32_t previous(std::int32_t v) const {
    return v > loop_starts[loop(v)] ? v - 1 : loop_starts[loop(v) + 1] - 1;
  }

  /// Whether two different segments meet where they must not: anywhere, or for neighbours outside their
  /// common point.
  bool faulty(std::int32_t s, std::int32_t t) const;
  /// A common point of two segments for which faulty() holds; rounded for a crossing.
  Point meeting_point(std::int32_t s, std::int32_t t) const;
};

/// The pairs of segments that meet where they must not.
struct MeetingPairs {
  std::int32_t first = -1, second = -1;  ///< the first pair in the order of segments
  std::int64_t count = 0;
  bool complete = true;  ///< false if the search ended early, so that there may be more
};

/// Finds all of them with a spatial index. Meant for geometries known to be faulty.
MeetingPairs meeting_pairs(const FlatOutline& flat);

}  // namespace quadloop
