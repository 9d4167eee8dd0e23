#pragma once

#include <compare>
#include <functional>
#include <vector>

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

  /// What the triangle in a slot of the patch was, and what it is now; the smallest node first.
  struct Before {
    DelaunayPatch::Triangle nodes;
    FreedTriangle freed;
  };
  struct After {
    DelaunayPatch::Triangle nodes;
    std::int32_t block;
  };

 private:
  using Triangle = DelaunayPatch::Triangle;
  /// Of the slots that have changed.
  struct Changes {
    std::vector<Before> before;
    std::vector<After> after;
  };

  Changes flip(const StarHalo& halo, const std::function<TieRank(Point)>& rank_of);
  static bool is_uncertain(const StarHalo& halo, const DelaunayPatch& patch);
  Changes find_changes(const StarHalo& halo, const DelaunayPatch& patch);
  void compare(const StarHalo& halo, Changes changes);

  bool uncertain_ = false;
  std::vector<MadeTriangle> made_;
  std::vector<FreedTriangle> freed_;
  std::vector<GlobalNodeId> outgrown_;
};

}  // namespace quadloop
