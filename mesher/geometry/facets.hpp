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

  bool empty() const { return facets_.empty(); }
  /// The facet that is within half of its segment of the box along each axis, that with the longest segment
  /// if there are several; null if there is none.
  const Facet* longest_at(const Box& box) const;
  /// Half the segment of that facet; 0 if there is none.
  double least_size(const Box& box) const;

 private:
  std::vector<Facet> facets_;
  BoxTree zones_;
};

}  // namespace quadloop
