#pragma once

#include <span>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/segment_tree.hpp"

namespace quadloop {

/// Finds where two pieces of the outline face each other across a narrow part of the domain. O(log n + k) a
/// segment, k the segments near it.
class Proximity {
 public:
  explicit Proximity(const Geometry& geometry);

  /// Whether the domain between a piece of these segments inside the box and another piece of the outline is
  /// narrower than `width`. The gap is measured through the domain, between pieces that face each other
  /// within 60 degrees; the two sides of a kept corner, or of any bend that is shorter than three times the
  /// gap, are no gap.
  bool narrower(std::span<const std::int32_t> segments, const Box& box, double width) const;

  /// The segments of the outline at which the domain is narrower than `width`. O(n log n).
  struct NarrowParts {
    std::int64_t segments = 0;
    Point first;  ///< the middle of the first of them
  };
  NarrowParts narrow_parts(double width) const;

 private:
  bool faces(std::int32_t a, Point a_from, Point a_to, std::int32_t b, double width) const;
  bool is_one_bend(std::int32_t a, Point p, std::int32_t b, Point q, double gap) const;
  bool is_one_bend_onwards(std::int32_t a, Point p, std::int32_t b, Point q, double gap) const;

  const Geometry* geometry_;
  SegmentTree segments_;
  std::vector<double> arc_;         ///< length of its loop up to each vertex
  std::vector<double> turning_;     ///< degrees turned up to and with each vertex at points that are not kept
  std::vector<std::int32_t> kept_;  ///< kept points up to and with each vertex
};

}  // namespace quadloop
