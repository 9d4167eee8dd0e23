#pragma once

#include <cstdint>
#include <vector>

#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// A vertex that stands for a curve: the outline turns there and at a neighbour by more than 2 degrees, and
/// it is no corner. A flow in cells much smaller than the segments sees a polygon.
struct Facet {
  std::int32_t vertex = 0;
  double turn_degrees = 0;
  double segment = 0;  ///< length of the shorter segment that meets there
};

/// In the order of vertices.
std::vector<Facet> facets_of(const Geometry& geometry);

/// Where the facets of an outline are, and down to which size cells there do not resolve them.
class FacetZones {
 public:
  explicit FacetZones(const Geometry& geometry);

  bool empty() const { return least_.empty(); }
  /// Half the length of the shorter segment at a facet that is no farther than that from the box along each
  /// axis, the largest of several; 0 where there is none.
  double least_size(const Box& box) const;

 private:
  std::vector<double> least_;
  BoxTree zones_;
};

}  // namespace quadloop
