#pragma once

#include <compare>
#include <functional>
#include <vector>

#include "mesher/delaunay/delaunay_patch.hpp"
#include "mesher/delaunay/restore/star_halo.hpp"

namespace quadloop {

/// A triangle that did not exist before.
struct MadeTriangle {
  /// Number of the nearest removed triangle (by centroid) among those with its first node.
  std::int64_t near = 0;
  std::array<GlobalNodeId, 3> nodes;  ///< smallest first
  std::array<Point, 3> points;
  std::int32_t block = 0;
  friend auto operator<=>(const MadeTriangle&, const MadeTriangle&) = default;
};

/// A removed triangle.
struct FreedTriangle {
  std::int64_t number = 0;
  std::int32_t block = 0;
  friend auto operator<=>(const FreedTriangle&, const FreedTriangle&) = default;
};

/// The constrained Delaunay triangulation of a rank's part of a region, and its difference from the previous
/// triangles. A triangle is handled by the rank that owns the first of its nodes.
class RegionTriangulation {
 public:
  RegionTriangulation(const StarHalo& halo, const std::function<TieRank(Point)>& rank_of);

  /// Whether unknown triangles might change some around nodes that this rank owns. If so, the following lists
  /// are empty.
  bool uncertain() const { return uncertain_; }
  const std::vector<FreedTriangle>& freed() const { return freed_; }
  const std::vector<MadeTriangle>& made() const { return made_; }
  /// Nodes of new triangles at the region's border: triangles beyond it may no longer be Delaunay.
  const std::vector<GlobalNodeId>& outgrown() const { return outgrown_; }

  /// The previous and the new triangle in a slot of the patch, smallest node first.
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
  /// In the changed slots.
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
