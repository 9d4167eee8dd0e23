#include "mesher/geometry/facets.hpp"

#include <algorithm>

namespace quadloop {

std::vector<Facet> facets_of(const Geometry& geometry) {
  constexpr double visible_degrees = 2 + 1e-9;  // a circle of 180 points turns by 2 degrees, up to rounding
  const auto length_of = [&](std::int32_t s) {
    return length(geometry.point(geometry.next(s)) - geometry.point(s));
  };
  std::vector<Facet> facets;
  for (std::int32_t v = 0; v < geometry.size(); ++v) {
    const double turn = geometry.bend_degrees(v);
    if (turn <= visible_degrees) continue;
    const double beside =
        std::max(geometry.bend_degrees(geometry.previous(v)), geometry.bend_degrees(geometry.next(v)));
    if (beside > visible_degrees)
      facets.push_back({v, turn, std::min(length_of(v), length_of(geometry.previous(v)))});
  }
  return facets;
}

FacetZones::FacetZones(const Geometry& geometry) {
  std::vector<Box> zones;
  for (const Facet& facet : facets_of(geometry)) {
    const double half = facet.segment / 2;
    const Point p = geometry.point(facet.vertex);
    zones.push_back({p - Point{half, half}, p + Point{half, half}});
    least_.push_back(half);
  }
  zones_ = BoxTree(zones);
}

double FacetZones::least_size(const Box& box) const {
  double least = 0;
  zones_.for_each_meeting(box, [&](std::int32_t facet) { least = std::max(least, least_[facet]); });
  return least;
}

}  // namespace quadloop
