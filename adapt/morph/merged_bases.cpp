#include "adapt/morph/merged_bases.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mesher/build/short_edges.hpp"
#include "smoother/outline/outline_path.hpp"

namespace quadloop::adapt {

namespace {

/// Finds the bases of a geometry that are one node of the mesh.
class MergedBases {
 public:
  MergedBases(const Geometry& outline, const Geometry& geometry)
      : outline_{outline}, path_{outline}, g_{geometry}, own_path_{geometry} {}

  /// Returns the base that begins at vertex v: less than half of its loop, with no node of the mesh between.
  std::optional<ShortBase> base_at(std::int32_t v) const {
    if (!g_.kept(v) || is_node(v, g_.point(v))) return {};
    const double longest = own_path_.loop_length(g_.loop_of(v)) / 2;
    double way = 0;
    for (std::int32_t s = v;; s = g_.next(s)) {
      const std::int32_t end = g_.next(s);
      way += length(g_.point(end) - g_.point(s));
      if (way >= longest || is_node(end, g_.point(end))) return {};
      if (g_.kept(end) && is_node(v, merged_end(g_, {v, end}))) return ShortBase{v, end};
    }
  }

 private:
  /// Whether the point is a vertex of the mesh boundary, on a boundary that meets at vertex v.
  bool is_node(std::int32_t v, Point p) const {
    for (const std::int32_t s : std::array{g_.previous(v), v}) {
      const smoother::OutlinePlace place = path_.locate(p, g_.boundary(g_.boundary_of(s)).name);
      if (!place.valid()) continue;
      for (const std::int32_t node : {place.segment, outline_.next(place.segment)}) {
        if (length(outline_.point(node) - p) <= path_.tolerance()) return true;
      }
    }
    return false;
  }

  const Geometry& outline_;
  smoother::OutlinePath path_;
  const Geometry& g_;
  smoother::OutlinePath own_path_;
};

}  // namespace

Geometry with_bases_as_in(const Geometry& outline, const Geometry& geometry) {
  const MergedBases merged(outline, geometry);
  std::vector<ShortBase> bases;
  for (std::int32_t v = 0; v < geometry.size(); ++v) {
    if (const std::optional<ShortBase> base = merged.base_at(v)) bases.push_back(*base);
  }
  return bases.empty() ? geometry : with_merged(geometry, bases);
}

}  // namespace quadloop::adapt
