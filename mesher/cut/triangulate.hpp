#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// Decides between the two diagonals of four points on one circle: the diagonal through the point of the
/// highest key. Made of numbers that mirror images and quarter turns of the lattice keep, so that mirrored
/// input gives mirrored triangles.
struct TieKey {
  std::int8_t
      coarser = -1,
      finer = -1;  ///< trailing zeros of a lattice node's coordinates, the smaller first; -1 for other nodes
  double farther = 0,
         nearer = 0;  ///< distances along the axes from the leaf's corner of highest rank, the larger first
  friend auto operator<=>(const TieKey&, const TieKey&) = default;
};

using LocalTriangle = std::array<std::int32_t, 3>;

/// The constrained Delaunay triangulation of the region between loops: outlines counter-clockwise, holes
/// clockwise, which do not meet but at nodes. `loops` name nodes of `points`; no node is added. Ties are
/// broken by `keys`. Appends counter-clockwise triangles to `triangles`. Returns false where rounding would
/// leave a triangle without positive area in double precision.
class Triangulator {
 public:
  bool triangulate(std::span<const Point> points, std::span<const TieKey> keys,
                   std::span<const std::span<const std::int32_t>> loops,
                   std::vector<LocalTriangle>& triangles);

  /// The sine of the smallest angle of the triangles made last; below about 1e-11 rounding, not the outline,
  /// shaped a triangle.
  double smallest_sine() const { return smallest_sine_; }

 private:
  void measure();
  bool clip_ears(std::span<const std::int32_t> loop);
  bool is_ear(std::size_t i) const;
  void flip_to_delaunay(std::span<const std::span<const std::int32_t>> loops);
  bool flip_pass();
  bool should_flip(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) const;
  bool positive(std::int32_t a, std::int32_t b, std::int32_t c) const;
  Point at(std::int32_t node) const { return points_[static_cast<std::size_t>(node)]; }

  struct HalfEdge {
    std::int64_t name = 0;       ///< of the edge, the same for both directions
    std::int32_t triangle = -1;  ///< -1: an edge of a loop, which stays
    std::int32_t corner = 0;     ///< of the triangle, opposite the edge
  };

  std::span<const Point> points_;
  std::span<const TieKey> keys_;
  std::vector<LocalTriangle> triangles_;
  std::vector<std::int32_t> ring_;
  std::vector<HalfEdge> half_edges_;
  std::vector<HalfEdge> fixed_;
  std::vector<char> touched_;
  double smallest_sine_ = 1;
};

}  // namespace quadloop
