#pragma once

#include <vector>

#include "mesher/geometry/box_tree.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// For validate_geometry() only: the local mesh size, where the cells themselves may be fragments of larger
/// quadtree cells. Quadtree cell sizes change by at most half of their distance (largest gradation), so a
/// long cell nearby implies that quadtree cells here are not much smaller.
class CellReach {
 public:
  /// `mesh` is whole on this rank and must outlive the object; `longest` has the longest edge of each cell,
  /// triangles first.
  CellReach(const Mesh& mesh, const std::vector<double>& longest) : mesh_{mesh}, longest_{longest} {}

  /// Returns the maximum of longest edge minus half the distance to the point, over nearby cells; the longest
  /// edge of the nearest cell if none is nearby. The search stops at `enough` and extends to 16 times
  /// `enough` at most. Builds the index on first use.
  double size_at(Point p, double enough);

  /// Returns the longest edge of the cells within `distance` of the point; that of the nearest cell if there
  /// is none.
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
