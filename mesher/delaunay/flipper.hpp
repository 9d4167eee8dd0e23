#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "mesher/delaunay/tie_order.hpp"
#include "mesher/geometry/point.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

/// Counter-clockwise exactly, and by the plain products in doubles that every reader of the mesh will use, at
/// each corner.
inline bool is_positive(Point a, Point b, Point c) {
  return cross(b - a, c - a) > 0 && cross(c - b, a - b) > 0 && cross(a - c, b - c) > 0 &&
         orientation(a, b, c) > 0;
}

/// Whether the edge a-b between the triangles a b c and b a d should give way to c-d. Of four points on one
/// circle that with the highest rank gets the edge; `rank_of(k)` is the rank of the k-th of a, b, c, d.
/// Exact; never where a new triangle would not be positive.
template <class RankOf>
bool should_flip(Point a, Point b, Point c, Point d, const RankOf& rank_of) {
  const int inside = in_circle(a, b, c, d);
  if (inside < 0) return false;
  if (inside == 0 && !(std::max(rank_of(2), rank_of(3)) > std::max(rank_of(0), rank_of(1)))) return false;
  return is_positive(a, d, c) && is_positive(d, b, c);
}

/// Makes a triangulation constrained Delaunay by flips (Lawson 1977). Keeps its memory for the next one.
class Flipper {
 public:
  using Triangle = std::array<std::int32_t, 3>;
  /// The edge of a triangle opposite its node k is number 3 t + k.
  using Edge = std::int32_t;
  static constexpr Edge border = -1, open_border = -2;

  /// The rank of a node for a choice between diagonals.
  using RankOf = std::function<TieRank(std::int32_t)>;

  /// Flips edges of counter-clockwise `triangles` over the `points`, which the edges shared by two of them
  /// join. Edges with one triangle stay, and those between triangles of two `blocks` (one for each triangle,
  /// or none where all are of one block). If the order of ranks is strict, the result depends on
  /// points, ranks and such edges alone, not on the triangles at the beginning; triangles keep their blocks.
  /// Where `open` (a flag for each triangle, or none) is set, an edge with one triangle becomes an open
  /// border.
  /// `moved` (a flag for each point, or none) says that the triangles were constrained Delaunay before these
  /// moved: an edge of two triangles without a moved node then gives way to no other diagonal of four nodes
  /// on one circle, whatever their ranks, and the result depends on such edges, too. It is still unique: an
  /// edge that flips though it is no tie is of no Delaunay triangulation, and between the edges that stay the
  /// ranks decide.
  void flip_to_delaunay(std::span<const Point> points, const RankOf& rank_of, std::span<Triangle> triangles,
                        std::span<const char> open = {}, std::span<const std::int32_t> blocks = {},
                        std::span<const char> moved = {});

  /// The same where all edges that may be wrong are those of the first `count` triangles.
  void flip_first(std::span<const Point> points, const RankOf& rank_of, std::span<Triangle> triangles,
                  std::size_t count);

  /// The same edge of the triangle beyond it, `border` or `open_border`, after the flips.
  Edge across(Edge e) const { return across_[e]; }
  static std::size_t triangle_of(Edge e) { return e / 3; }
  static std::size_t corner_of(Edge e, int step) { return (e % 3 + step) % 3; }

 private:
  Edge edges() const { return static_cast<Edge>(across_.size()); }
  std::int32_t node(Edge e, int step) const { return triangles_[triangle_of(e)][corner_of(e, step)]; }
  std::int32_t low(Edge e) const { return std::min(node(e, 1), node(e, 2)); }
  std::int32_t high(Edge e) const { return std::max(node(e, 1), node(e, 2)); }
  void join(std::span<const std::int32_t> blocks);
  void close(std::span<const char> open);
  void list_firm(std::span<const char> moved);
  void list_blunt();
  bool is_blunt(Edge e) const { return (blunt_[triangle_of(e)] >> corner_of(e, 0) & 1U) != 0; }
  bool is_firm(Edge e) const { return !firm_.empty() && firm_[e] != 0; }
  std::array<std::size_t, 4> nodes_of_both(Edge e) const;
  bool is_wrong(Edge e, const RankOf& rank_of) const;
  void flip_below(Edge end, const RankOf& rank_of);
  void flip_from(Edge e, const RankOf& rank_of);
  void flip(Edge e);
  void set_across(Edge e, Edge other);
  void keep_firm(Edge e, Edge f);

  std::span<const Point> points_;
  std::span<Triangle> triangles_;
  std::vector<Edge> across_;
  std::vector<char> firm_;           ///< a flag for each edge that gives way to no tie; or none
  std::vector<char> moved_;          ///< a flag for each triangle with a moved node
  std::vector<std::uint8_t> blunt_;  ///< the blunt_corners of each triangle before the flips
  std::vector<Edge> last_low_;  ///< of each node, the last edge with it as the lower end and one triangle
  std::vector<Edge> waiting_;
};

}  // namespace quadloop
