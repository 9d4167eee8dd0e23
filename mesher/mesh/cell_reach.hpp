#pragma once

#include <boost/geometry.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <utility>
#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Inside validate_geometry() only: how long cells are round a place, for what a mesh of that size cannot show. Built at the first question.
class CellReach {
 public:
  /// `mesh` is whole on this rank and outlives this; `longest` has the longest edge of each cell, triangles first.
  CellReach(const Mesh& mesh, const std::vector<double>& longest) : mesh_{mesh}, longest_{longest} {}

  /// The longest edge of the cells that come within `distance` of the point; of the nearest cell where none does.
  double longest_within(Point p, double distance);

 private:
  using IndexPoint = boost::geometry::model::point<double, 2, boost::geometry::cs::cartesian>;
  using IndexBox = boost::geometry::model::box<IndexPoint>;
  using Entry = std::pair<IndexBox, std::int32_t>;

  void build();
  double distance_to(std::int32_t cell, Point p) const;

  const Mesh& mesh_;
  const std::vector<double>& longest_;
  boost::geometry::index::rtree<Entry, boost::geometry::index::quadratic<16>> cells_;
};

/// Of a point to a segment.
double distance_to_segment(Point p, Point a, Point b);

}  // namespace quadloop
