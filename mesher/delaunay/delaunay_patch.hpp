#pragma once

#include "mesher/delaunay/flipper.hpp"

namespace quadloop {

/// The constrained Delaunay triangulation of a part of the domain, which may go on beyond it.
class DelaunayPatch {
 public:
  using Triangle = Flipper::Triangle;

  /// From any counter-clockwise triangles over the nodes, as Flipper makes it. Where `open` is set for a
  /// triangle, the domain may go on across its edges that have no other triangle. `moved` as Flipper has it.
  DelaunayPatch(std::vector<Point> points, const std::vector<TieRank>& ranks, std::vector<Triangle> triangles,
                const std::vector<char>& open, const std::vector<std::int32_t>& blocks = {},
                const std::vector<char>& moved = {})
      : points_{std::move(points)}, triangles_{std::move(triangles)} {
    flipper_.flip_to_delaunay(points_, ranks, triangles_, open, blocks, moved);
  }

  const std::vector<Triangle>& triangles() const { return triangles_; }
  const Point& point(std::int32_t node) const { return points_[node]; }

  /// A flag for each triangle that nodes across the open edges might undo: one whose circumcircle reaches
  /// such an edge, with all between them.
  std::vector<char> doubtful() const;

 private:
  bool circle_reaches(std::size_t triangle, Point from, Point to) const;

  std::vector<Point> points_;
  std::vector<Triangle> triangles_;
  Flipper flipper_;
};

}  // namespace quadloop
