#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "smoother/outline/outline_path.hpp"

namespace quadloop::adapt {

/// Returns an outline whose loops have the direction of those of the same names in `like`. A single outline,
/// e.g. of an airfoil without far field, does not define the side of the domain.
Geometry walked_as(const Geometry& like, const Geometry& outline);

/// Returns a flag for each loop of the outline: whether walked_as() reverses it.
std::vector<char> loops_against(const Geometry& like, const Geometry& outline);

/// A point as a weighted mean of two points of a geometry.
struct PointShares {
  std::int32_t first = -1, second = -1;  ///< vertices; -1: the point does not move
  double share = 0;                      ///< weight of the second; that of the first is 1 - share
};

/// Maps points of a geometry to another one of similar shape: loop by loop, with relative arc length between
/// corresponding vertices. With `by_points` and equal numbers of points all vertices correspond, wherever the
/// loops begin. Otherwise the feature points of the new geometry correspond to the sharpest vertices of the
/// old one, and between these, old vertices that lie on the new geometry stay in place, unless this would
/// halve or double the length of a part between two of them. Loops with names that the new geometry lacks
/// have no image. The map is a smooth function of the new geometry's points as long as the correspondence
/// does not change.
class OutlineMap {
 public:
  /// Names of the geometries in messages: the new one's file, the old one's or "the mesh".
  struct Names {
    std::string to, from;
  };
  /// Both geometries must outlive the object. Throws InputError if a loop or a corner has no counterpart.
  OutlineMap(const Geometry& from, const Geometry& to, bool by_points, const Names& names);
  /// The map of OutlinePieces: loop by loop and vertex by vertex, in their order.
  OutlineMap(const Geometry& from, const Geometry& to);

  bool maps(std::int32_t loop) const { return loops_[loop].image >= 0; }
  /// `arc`: arc length along the loop from its first vertex.
  Point image(std::int32_t loop, double arc) const;
  /// Returns the image as a weighted mean of new points; empty if the loop's points do not correspond
  /// one-to-one, as the arc length then depends on all of them.
  std::optional<PointShares> shares(std::int32_t loop, double arc) const;

 private:
  /// Corresponding positions, ascending along the old loop from its first vertex.
  struct LoopMap {
    std::int32_t image = -1;  ///< new loop; -1: none
    std::vector<double> from, to;
    std::vector<std::int32_t> to_vertices;  ///< new vertices, if all correspond
  };
  /// Corresponding positions on the old and the new loop, by arc length.
  struct Anchor {
    double from, to;
  };
  /// The interval that contains an arc length, and the relative position in it.
  struct Stretch {
    std::size_t number;
    double share;
  };
  Stretch stretch_at(std::int32_t loop, double arc) const;
  void match_loops(const Names& names);
  [[noreturn]] void refuse_loop(std::int32_t image, const Names& names) const;
  /// Counterparts begin at the one numbered `turn`.
  LoopMap anchored(std::int32_t image, const std::vector<std::int32_t>& corners,
                   const std::vector<std::int32_t>& counterparts, std::size_t turn) const;
  /// Empty if the loops have different numbers of points, or names.
  std::optional<LoopMap> point_by_point(std::int32_t loop, std::int32_t image) const;
  LoopMap by_corners(std::int32_t loop, std::int32_t image, const Names& names) const;
  /// Returns the old vertices that lie on the new loop, ascending.
  std::vector<Anchor> fixed_vertices(std::int32_t loop, std::int32_t image) const;
  /// Returns the map with those of them that may stay as further anchors.
  LoopMap with_fixed(std::int32_t loop, const LoopMap& map, std::vector<Anchor> standing) const;
  static bool may_stay(Anchor begin, std::span<const Anchor> between, Anchor end);
  /// Empty if a vertex of the old loop does not lie on the new one, or a corner of that is farther from the
  /// old one's edge than half of the edge, so that the edge is not the trace of a corner lost by the mesh.
  std::optional<LoopMap> unchanged(std::int32_t loop, std::int32_t image,
                                   const std::vector<Anchor>& standing) const;

  const Geometry &from_, &to_;
  smoother::OutlinePath old_path_, new_path_;
  std::vector<LoopMap> loops_;
};

}  // namespace quadloop::adapt
