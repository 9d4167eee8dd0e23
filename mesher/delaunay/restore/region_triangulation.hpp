#pragma once

#include <compare>
#include <functional>

#include "mesher/delaunay/delaunay_patch.hpp"
#include "mesher/delaunay/restore/star_halo.hpp"

namespace quadloop {

/// A triangle that was not there before.
struct MadeTriangle {
  std::int64_t near = 0;  ///< the number of the nearest triangle, by their centroids, of those with its first
                          ///< node that are gone
  std::array<GlobalNodeId, 3> nodes;  ///< the smallest first
  std::array<Point, 3> points;
  std::int32_t block = 0;
  friend auto operator<=>(const MadeTriangle&, const MadeTriangle&) = default;
};

/// A triangle that is gone.
struct FreedTriangle {
  std::int64_t number = 0;
  std::int32_t block = 0;
  friend auto operator<=>(const FreedTriangle&, const FreedTriangle&) = default;
};

/// The constrained Delaunay triangulation of what a rank knows of a region, and how it differs from the
/// triangles before. A triangle is this rank's concern where it owns the first of its nodes.
class RegionTriangulation {
 public:
  RegionTriangulation(const StarHalo& halo, const std::function<TieRank(Point)>& rank_of);

  /// Whether triangles not at hand might change some around nodes that this rank owns. If so, the following
  /// are empty.
  bool uncertain() const { return uncertain_; }
  const std::vector<FreedTriangle>& freed() const { return freed_; }
  const std::vector<MadeTriangle>& made() const { return made_; }
  /// Nodes of new triangles at the region's border: the triangles beyond it may no longer be Delaunay.
  const std::vector<GlobalNodeId>& outgrown() const { return outgrown_; }

 private:
  using Triangle = DelaunayPatch::Triangle;
  using Edge = std::array<std::int32_t, 2>;
  /// What triangles in some slots of the patch were, and what they are now; the smallest node first.
  struct Changes {
    std::vector<std::pair<Triangle, FreedTriangle>> before;
    std::vector<std::pair<Triangle, std::int32_t>> after;  ///< with their blocks
  };

  void gather_nodes(const StarHalo& halo);
  Changes flip(const StarHalo& halo, const std::function<TieRank(Point)>& rank_of);
  DelaunayPatch make_patch(const StarHalo& halo, const std::function<TieRank(Point)>& rank_of) const;
  Changes find_changes(const StarHalo& halo, const DelaunayPatch& patch) const;
  void compare(const StarHalo& halo, const Changes& changes);
  Point centroid(const Triangle& nodes) const;
  void find_outgrown();
  std::vector<Edge> outer_edges() const;

  GlobalNodeId number_of(std::int32_t node) const { return numbers_[node]; }
  bool is_core(std::int32_t node) const { return core_[node] != 0; }

  std::vector<GlobalNodeId> numbers_;  ///< of the nodes at hand, ascending
  std::vector<Point> points_;          ///< of each
  std::vector<char> core_, moved_;     ///< of each
  std::vector<Triangle> triangles_;    ///< at hand, before any flip
  std::vector<std::int32_t> blocks_;   ///< of each; flips do not change them
  bool uncertain_ = false;
  std::vector<Triangle> new_triangles_;  ///< this rank's concern
  std::vector<MadeTriangle> made_;
  std::vector<FreedTriangle> freed_;
  std::vector<GlobalNodeId> outgrown_;
};

}  // namespace quadloop
