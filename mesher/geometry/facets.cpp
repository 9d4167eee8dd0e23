#include "mesher/geometry/facets.hpp"

#include <algorithm>

namespace quadloop {

namespace {

constexpr double visible_degrees = 2 + 1e-9;  // a circle of 180 points turns by 2 degrees, up to rounding

std::vector<double> bends_of(const Geometry& geometry) {
  std::vector<double> bends(geometry.size());
  for (std::int32_t v = 0; v < geometry.size(); ++v) bends[v] = geometry.bend_degrees(v);
  return bends;
}

/// Finds the facets of a geometry; each turning angle is computed once.
class FacetFinder {
 public:
  explicit FacetFinder(const Geometry& geometry) : geometry_{geometry}, bends_{bends_of(geometry)} {}

  /// Chords of a curve are no sides of a polygon.
  bool is_facet(std::int32_t v) const {
    return bends_[v] > visible_degrees &&
           !(geometry_.is_curved(v) && geometry_.is_curved(geometry_.previous(v)));
  }

  std::vector<Facet> facets() const {
    std::vector<Facet> facets;
    for (std::int32_t v = 0; v < geometry_.size(); ++v) {
      if (!is_facet(v)) continue;
      const Side before = side_from(v, [&](std::int32_t u) { return geometry_.previous(u); }),
                 after = side_from(v, [&](std::int32_t u) { return geometry_.next(u); });
      if (before.ends_in_facet || after.ends_in_facet)
        facets.push_back({v, bends_[v], std::min(after.length, before.length)});
    }
    return facets;
  }

 private:
  /// A straight side of a polygon, from a vertex to the next one that is not on it.
  struct Side {
    double length = 0;
    bool ends_in_facet = false;
  };

  /// Points on the side turn by no more than rounded coordinates do.
  template <class Next>
  Side side_from(std::int32_t v, const Next& next) const {
    constexpr double straight_degrees = 0.1;
    Side side;
    double turned = 0;
    std::int32_t u = v;
    do {
      side.length += length(geometry_.point(next(u)) - geometry_.point(u));
      u = next(u);
      turned += bends_[u];
    } while (u != v && !geometry_.kept(u) && turned <= straight_degrees);
    side.ends_in_facet = u != v && is_facet(u);
    return side;
  }

  const Geometry& geometry_;
  std::vector<double> bends_;
};

}  // namespace

std::vector<Facet> facets_of(const Geometry& geometry) { return FacetFinder(geometry).facets(); }

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
