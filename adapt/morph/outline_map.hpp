#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "smoother/outline/outline_path.hpp"

namespace quadloop {

/// An outline whose loops are walked as those of the same names are in `like`; an outline alone, as that of
/// an airfoil without its far field, does not know on which side the domain lies.
Geometry walked_as(const Geometry& like, const Geometry& outline);

/// A flag for each loop of the outline: whether walked_as() turns it.
std::vector<char> loops_against(const Geometry& like, const Geometry& outline);

/// A place as a mean of two points of an outline.
struct PointShares {
  std::int32_t first = -1, second = -1;  ///< vertices; -1: the place stays where it is
  double share = 0;                      ///< of the second; 1 - share is the first one's
};

/// Takes places of an outline to places of another one of the same shape in the large: loop by loop, between
/// vertices that stand for each other by shares of the way. Those vertices are all of them where both
/// outlines have as many and `by_points` is asked for, wherever the loops begin, else the kept ones of the
/// new outline and the sharpest of the old, and between these the old vertices that lie on the new outline,
/// which stay, unless that would halve or double the length of a part between two of them. Loops of names
/// that the new outline lacks have no image. A smooth function of the new outline's points as long as the
/// same vertices stand for each other.
class OutlineMap {
 public:
  /// What messages call the outlines: the new one's file, the old one's or "the mesh".
  struct Names {
    std::string to, from;
  };
  /// Both outlines must outlive it. Throws InputError where a loop or a corner has no counterpart.
  OutlineMap(const Geometry& from, const Geometry& to, bool by_points, const Names& names);

  bool maps(std::int32_t loop) const { return loops_[loop].image >= 0; }
  /// `arc`: the way along the loop from its first vertex.
  Point image(std::int32_t loop, double arc) const;
  /// The same place as a mean of new points; none where the loop's points do not stand for each other, as the
  /// way to it is then a function of all of them.
  std::optional<PointShares> shares(std::int32_t loop, double arc) const;

 private:
  /// Places that stand for each other, ascending along the old loop from its first one on.
  struct LoopMap {
    std::int32_t image = -1;  ///< the new loop; -1: none
    std::vector<double> from, to;
    std::vector<std::int32_t> to_vertices;  ///< the new ones, where all stand for each other
  };
  /// A place on the old loop and the one that it goes to, by their arcs.
  struct Anchor {
    double from, to;
  };
  /// The number of the stretch that an arc lies on, and its share of the way along that.
  struct Stretch {
    std::size_t number;
    double share;
  };
  Stretch stretch_at(std::int32_t loop, double arc) const;
  void match_loops(const Names& names);
  /// Counterparts begin at the one numbered `turn`.
  LoopMap anchored(std::int32_t image, const std::vector<std::int32_t>& corners,
                   const std::vector<std::int32_t>& counterparts, std::size_t turn) const;
  /// None where the loops have other numbers of points, or names.
  std::optional<LoopMap> point_by_point(std::int32_t loop, std::int32_t image) const;
  LoopMap by_corners(std::int32_t loop, std::int32_t image, const Names& names) const;
  /// The old vertices that lie on the new loop, ascending.
  std::vector<Anchor> standing_vertices(std::int32_t loop, std::int32_t image) const;
  /// The map with those of them as further anchors that may stay.
  LoopMap with_standing(std::int32_t loop, const LoopMap& map, std::vector<Anchor> standing) const;
  static bool may_stay(Anchor begin, std::span<const Anchor> between, Anchor end);
  /// None where a vertex of the old loop does not lie on the new one, or a corner of that has no vertex.
  std::optional<LoopMap> unchanged(std::int32_t loop, std::int32_t image,
                                   const std::vector<Anchor>& standing) const;

  const Geometry &from_, &to_;
  OutlinePath old_path_, new_path_;
  std::vector<LoopMap> loops_;
};

}  // namespace quadloop
