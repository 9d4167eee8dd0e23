#pragma once

#include <cstdint>
#include <vector>

#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// A vertex of a polygonal approximation of a curve: the geometry turns there and at an end of a side that
/// meets there by more than 2 degrees, and the vertex is no corner. Points on a straight side do not count.
/// In cells much smaller than the sides the flow sees a polygon.
struct Facet {
  std::int32_t vertex = 0;
  double turn_degrees = 0;
  double segment = 0;  ///< length of the shorter side that meets there
};

/// The facets in the order of vertices.
std::vector<Facet> facets_of(const Geometry& geometry);

/// The places of facets, and the cell size below which cells resolve the polygon.
class FacetZones {
 public:
  explicit FacetZones(const Geometry& geometry);

  bool empty() const { return least_.empty(); }
  /// Half the length of the shorter side at a facet that is within this distance of the box along each
  /// axis, the largest if there are several; 0 if there is none.
  double least_size(const Box& box) const;

 private:
  std::vector<double> least_;
  BoxTree zones_;
};

}  // namespace quadloop
