#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "mesher/delaunay/tie_order.hpp"
#include "mesher/geometry/point.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

/// Whether a triangle is counter-clockwise both exactly and, at each corner, by the plain products in doubles
/// that readers of the mesh will use.
inline bool is_positive(Point a, Point b, Point c) {
  return cross(b - a, c - a) > 0 && cross(c - b, a - b) > 0 && cross(a - c, b - c) > 0 &&
         orientation(a, b, c) > 0;
}

/// Whether the edge a-b between the triangles a b c and b a d should be replaced by c-d. If the four points
/// are on one circle, the point with the highest rank gets the edge; `rank_of(k)` is the rank of the k-th of
/// a, b, c, d. Exact; false if a new triangle would not be positive.
template <class RankOf>
bool should_flip(Point a, Point b, Point c, Point d, const RankOf& rank_of) {
  const int inside = in_circle(a, b, c, d);
  if (inside < 0) return false;
  if (inside == 0 && !(std::max(rank_of(2), rank_of(3)) > std::max(rank_of(0), rank_of(1)))) return false;
  return is_positive(a, d, c) && is_positive(d, b, c);
}

/// Makes a triangulation constrained Delaunay by flips (Lawson 1977). Its memory is reused by the next call.
class Flipper {
 public:
  using Triangle = std::array<std::int32_t, 3>;
  /// The edge of a triangle opposite its node k is number 3 t + k.
  using Edge = std::int32_t;
  static constexpr Edge border = -1, open_border = -2;

  /// The rank of a node for the choice between diagonals.
  using RankOf = std::function<TieRank(std::int32_t)>;

  /// An edge by its nodes, the lower one first.
  using Ends = std::array<std::int32_t, 2>;
  /// Edges that the next calls do not flip, whatever triangles they belong to; ascending.
  void keep(std::vector<Ends> edges) { kept_ = std::move(edges); }

  /// Flips edges of counter-clockwise `triangles` over the `points`; edges with the same ends are joined.
  /// Edges with one triangle are kept, those of keep(), and edges between triangles of two `blocks` (one
  /// entry per triangle; empty: one block). If the order of ranks is strict, the result depends only on
  /// points, ranks and kept edges, not on the initial triangles. Triangles keep their blocks. Where `open` (a
  /// flag per triangle, or empty) is set, an edge with one triangle becomes an open border. `moved` (a flag
  /// per point, or empty): the triangles were constrained Delaunay before these points moved. Then an edge of
  /// two triangles without a moved node is not replaced by the other diagonal of four nodes on one circle,
  /// whatever their ranks, and the result also depends on such edges. It is still unique: an edge that flips
  /// without being a tie belongs to no Delaunay triangulation, and between the kept edges the ranks decide.
  void flip_to_delaunay(std::span<const Point> points, const RankOf& rank_of, std::span<Triangle> triangles,
                        std::span<const char> open = {}, std::span<const std::int32_t> blocks = {},
                        std::span<const char> moved = {});

  /// Same, if all edges that may be wrong belong to the first `count` triangles.
  void flip_first(std::span<const Point> points, const RankOf& rank_of, std::span<Triangle> triangles,
                  std::size_t count, std::span<const std::int32_t> blocks = {});

  /// The same edge in the adjacent triangle, `border` or `open_border`, after the flips.
  Edge across(Edge e) const { return across_[e]; }
  static std::size_t triangle_of(Edge e) { return e / 3; }
  static std::size_t corner_of(Edge e, int step) { return (e % 3 + step) % 3; }

 private:
  Edge edges() const { return static_cast<Edge>(across_.size()); }
  std::int32_t node(Edge e, int step) const { return triangles_[triangle_of(e)][corner_of(e, step)]; }
  std::int32_t low(Edge e) const { return std::min(node(e, 1), node(e, 2)); }
  std::int32_t high(Edge e) const { return std::max(node(e, 1), node(e, 2)); }
  void join(std::span<const std::int32_t> blocks);
  bool is_kept(Edge e) const {
    return !kept_.empty() && std::ranges::binary_search(kept_, Ends{low(e), high(e)});
  }
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
  std::vector<char> firm_;           ///< flags the edges that no tie may flip; may be empty
  std::vector<char> moved_;          ///< flags the triangles with a moved node
  std::vector<std::uint8_t> blunt_;  ///< blunt_corners() of each triangle before the flips
  /// For each node the last edge that has it as lower end and only one triangle.
  std::vector<Edge> last_low_;
  std::vector<Edge> waiting_;
  std::vector<Ends> kept_;
};

}  // namespace quadloop
