#pragma once

#include "mesher/delaunay/flipper.hpp"

namespace quadloop {

/// The constrained Delaunay triangulation of a part of the domain, which may continue beyond it.
class DelaunayPatch {
 public:
  using Triangle = Flipper::Triangle;

  /// Starts from any counter-clockwise triangles over the nodes. Where `open` is set for a triangle, the
  /// domain may continue across its edges that have no other triangle. `rank_of`, `moved` and `kept` as in
  /// Flipper. The points must outlive the patch.
  DelaunayPatch(std::span<const Point> points, const Flipper::RankOf& rank_of,
                std::vector<Triangle> triangles, const std::vector<char>& open,
                const std::vector<std::int32_t>& blocks = {}, std::span<const char> moved = {},
                std::vector<Flipper::Ends> kept = {})
      : points_{points}, triangles_{std::move(triangles)} {
    flipper_.keep(std::move(kept));
    flipper_.flip_to_delaunay(points_, rank_of, triangles_, open, blocks, moved);
  }

  const std::vector<Triangle>& triangles() const { return triangles_; }
  const Point& point(std::int32_t node) const { return points_[node]; }

  /// Flags the triangles that nodes beyond the open edges might invalidate: those whose circumcircle reaches
  /// such an edge.
  std::vector<char> doubtful() const;

  /// Whether an edge of the triangle has no second triangle of its block, and `may(node)` holds for both its
  /// ends.
  template <class May>
  bool has_single_edge(std::size_t triangle, const May& may) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& nodes = triangles_[triangle];
      if (flipper_.across(static_cast<Flipper::Edge>(3 * triangle + k)) < 0 && may(nodes[(k + 1) % 3]) &&
          may(nodes[(k + 2) % 3]))
        return true;
    }
    return false;
  }

 private:
  bool circle_reaches(std::size_t triangle, Point from, Point to) const;

  std::span<const Point> points_;
  std::vector<Triangle> triangles_;
  Flipper flipper_;
};

}  // namespace quadloop
