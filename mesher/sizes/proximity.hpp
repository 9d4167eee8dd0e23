#pragma once

#include <span>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/segment_tree.hpp"

namespace quadloop {

/// Finds where two parts of the boundary face each other across a narrow part of the domain. O(log n + k) per
/// segment, with k nearby segments.
class Proximity {
 public:
  explicit Proximity(const Geometry& geometry);

  /// Whether the domain between a part of these segments inside the box and another part of the boundary is
  /// narrower than `width`. The gap is measured through the domain, between parts that face each other within
  /// 60 degrees; the two sides of a feature point, or of a bend shorter than three times the gap, do not
  /// count.
  bool narrower(std::span<const std::int32_t> segments, const Box& box, double width) const;

  /// Segments of the geometry where the domain is narrower than `width`. O(n log n).
  struct NarrowParts {
    std::int64_t segments = 0;
    Point first;  ///< midpoint of the first of them
  };
  NarrowParts narrow_parts(double width) const;

 private:
  bool faces(std::int32_t a, Point a_from, Point a_to, std::int32_t b, double width) const;
  bool is_one_bend(std::int32_t a, Point p, std::int32_t b, Point q, double gap) const;
  bool is_one_bend_onwards(std::int32_t a, Point p, std::int32_t b, Point q, double gap) const;

  const Geometry* geometry_;
  SegmentTree segments_;
  std::vector<double> arc_;  ///< arc length of its loop up to each vertex
  /// Degrees turned up to and including each vertex at points that are not feature points.
  std::vector<double> turning_;
  std::vector<std::int32_t> kept_;  ///< number of feature points up to and including each vertex
};

}  // namespace quadloop
