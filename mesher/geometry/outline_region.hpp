#pragma once

#include <utility>
#include <vector>

#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// A region of the plane by the edges around it, in any order; curves count as their chords.
class OutlineRegion {
 public:
  explicit OutlineRegion(std::vector<std::pair<Point, Point>> edges);
  /// One block of a geometry.
  OutlineRegion(const Geometry& geometry, std::int32_t block);

  /// Whether the closed region and the closed box have a point in common. O(log n + k) for k edges near the
  /// box or the ray to the left of its centre.
  bool meets(const Box& box) const;
  const Box& box() const { return box_; }

 private:
  bool contains(Point p) const;

  std::vector<std::pair<Point, Point>> edges_;
  BoxTree tree_;
  Box box_;
};

}  // namespace quadloop
