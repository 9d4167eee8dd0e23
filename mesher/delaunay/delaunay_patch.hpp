#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/delaunay/tie_order.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A triangulation of a part of the domain that is made constrained Delaunay by flips (Lawson 1977), with
/// exact in-circle tests. Edges with one triangle, or between two blocks, stay. The result depends on nodes,
/// ranks and such edges alone, not on the triangles at the beginning.
class DelaunayPatch {
 public:
  using Triangle = std::array<std::int32_t, 3>;

  /// Counter-clockwise triangles over the nodes, which edges shared by two of them join. Where `open` is set
  /// for a triangle, the domain may go on across its edges that have no other triangle. Edges between
  /// triangles of two blocks stay as the border does; `blocks` has one for each triangle, or none where all
  /// are of one block.
  DelaunayPatch(std::vector<Point> points, std::vector<TieRank> ranks, std::vector<Triangle> triangles,
                const std::vector<char>& open, const std::vector<std::int32_t>& blocks = {});

  void flip_to_delaunay();

  const std::vector<Triangle>& triangles() const { return triangles_; }
  const Point& point(std::int32_t node) const { return points_[static_cast<std::size_t>(node)]; }

  /// A flag for each triangle that nodes across the open edges might undo: one whose circumcircle reaches
  /// such an edge, with all between them.
  std::vector<char> doubtful() const;

 private:
  static constexpr std::int32_t border = -1, open_border = -2;
  /// The edge of a triangle opposite its node k is number 3 t + k.
  using Edge = std::int32_t;
  static std::size_t triangle_of(Edge e) { return static_cast<std::size_t>(e / 3); }
  std::int32_t node(Edge e, int step) const {
    return triangles_[triangle_of(e)][static_cast<std::size_t>((e % 3 + step) % 3)];
  }
  Edge& across(Edge e) { return across_[static_cast<std::size_t>(e)]; }
  Edge across(Edge e) const { return across_[static_cast<std::size_t>(e)]; }

  void join(const std::vector<char>& open, const std::vector<std::int32_t>& blocks);
  bool should_flip(Edge e) const;
  bool positive(std::int32_t a, std::int32_t b, std::int32_t c) const;
  void flip(Edge e);
  void set_across(Edge e, Edge other);
  bool circle_reaches(std::size_t triangle, Point from, Point to) const;

  std::vector<Point> points_;
  std::vector<TieRank> ranks_;
  std::vector<Triangle> triangles_;
  std::vector<Edge> across_;
};

}  // namespace quadloop
