#include "mesher/geometry/facets.hpp"

#include <algorithm>

namespace quadloop {

namespace {

constexpr double visible_degrees = 2 + 1e-9;  // a circle of 180 points turns by 2 degrees, up to rounding

/// Chords of a curve are no sides of a polygon.
double turn_of_polygon(const Geometry& geometry, std::int32_t v) {
  const bool curved = geometry.is_curved(v) && geometry.is_curved(geometry.previous(v));
  return curved ? 0 : geometry.bend_degrees(v);
}

/// A straight side of a polygon, from a vertex to the next one that is not on it.
struct Side {
  double length = 0;
  bool ends_in_facet = false;
};

/// Points on the side turn by no more than rounded coordinates do.
template <class Next>
Side side_from(const Geometry& geometry, std::int32_t v, const Next& next) {
  constexpr double straight_degrees = 0.1;
  Side side;
  double turned = 0;
  std::int32_t u = v;
  do {
    side.length += length(geometry.point(next(u)) - geometry.point(u));
    u = next(u);
    turned += geometry.bend_degrees(u);
  } while (u != v && !geometry.kept(u) && turned <= straight_degrees);
  side.ends_in_facet = u != v && turn_of_polygon(geometry, u) > visible_degrees;
  return side;
}

}  // namespace

std::vector<Facet> facets_of(const Geometry& geometry) {
  std::vector<Facet> facets;
  for (std::int32_t v = 0; v < geometry.size(); ++v) {
    const double turn = turn_of_polygon(geometry, v);
    if (turn <= visible_degrees) continue;
    const Side before = side_from(geometry, v, [&](std::int32_t u) { return geometry.previous(u); }),
               after = side_from(geometry, v, [&](std::int32_t u) { return geometry.next(u); });
    if (before.ends_in_facet || after.ends_in_facet)
      facets.push_back({v, turn, std::min(after.length, before.length)});
  }
  return facets;
}

FacetZones::FacetZones(const Geometry& geometry) : facets_{facets_of(geometry)} {
  std::vector<Box> zones;
  for (const Facet& facet : facets_) {
    const double half = facet.segment / 2;
    const Point p = geometry.point(facet.vertex);
    zones.push_back({p - Point{half, half}, p + Point{half, half}});
  }
  zones_ = BoxTree(zones);
}

const Facet* FacetZones::longest_at(const Box& box) const {
  const Facet* longest = nullptr;
  zones_.for_each_meeting(box, [&](std::int32_t number) {
    const Facet& facet = facets_[number];
    if (longest == nullptr || facet.segment > longest->segment) longest = &facet;
  });
  return longest;
}

double FacetZones::least_size(const Box& box) const {
  const Facet* facet = longest_at(box);
  return facet == nullptr ? 0 : facet->segment / 2;
}

}  // namespace quadloop
