#pragma once

#include <vector>

#include "mesher/geometry/box_tree.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Inside validate_geometry() only: how coarse a mesh is at a place, where the cells themselves may be
/// fragments of larger leaves. Sizes of leaves change by half of their distance at most (the largest
/// gradation), so a long cell near by says that leaves are not much smaller here.
class CellReach {
 public:
  /// `mesh` is whole on this rank and outlives this; `longest` has the longest edge of each cell, triangles
  /// first.
  CellReach(const Mesh& mesh, const std::vector<double>& longest) : mesh_{mesh}, longest_{longest} {}

  /// The largest of longest edge less half the distance to the point, over the cells near it; `enough` ends
  /// the search, which goes no farther than 16 times as far. Of the nearest cell the longest edge, where none
  /// is as near. Builds its index when first asked.
  double size_at(Point p, double enough);

  /// The longest edge of the cells that come within `distance` of the point; of the nearest cell, where none
  /// does.
  double longest_within(Point p, double distance);

 private:
  void build();
  double largest_within(Point p, double distance, double slope) const;
  double longest_of_nearest(Point p) const;
  double distance_to(std::int32_t cell, Point p) const;

  const Mesh& mesh_;
  const std::vector<double>& longest_;
  BoxTree cells_;
};

}  // namespace quadloop
