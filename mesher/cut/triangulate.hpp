#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/delaunay/flipper.hpp"

namespace quadloop {

using LocalTriangle = Flipper::Triangle;

/// Constrained Delaunay triangulation of the region between loops: outer loops counter-clockwise, holes
/// clockwise, which meet only at nodes or pass an edge in both directions; such an edge is kept, with the
/// region on both sides. `loops` are indices into `points`; no node is added. Ties are broken
/// by `rank_of`. Appends counter-clockwise triangles to `triangles`. Returns false if rounding would give a
/// triangle without positive area in double precision.
class Triangulator {
 public:
  bool triangulate(std::span<const Point> points, const Flipper::RankOf& rank_of,
                   std::span<const std::span<const std::int32_t>> loops,
                   std::vector<LocalTriangle>& triangles);

  /// Sine of the smallest angle of the last triangles; below about 1e-11 a triangle is due to rounding, not
  /// to the geometry.
  double smallest_sine() const { return smallest_sine_; }

 private:
  void measure();
  bool clip_ears(std::span<const std::int32_t> loop);
  bool is_ear(std::size_t i) const;
  Point at(std::int32_t node) const { return points_[node]; }

  std::span<const Point> points_;
  std::vector<LocalTriangle> triangles_;
  std::vector<std::int32_t> ring_;
  Flipper flipper_;
  double smallest_sine_ = 1;
};

}  // namespace quadloop
