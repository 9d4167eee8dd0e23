#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/delaunay/flipper.hpp"

namespace quadloop {

using LocalTriangle = Flipper::Triangle;

/// The constrained Delaunay triangulation of the region between loops: outlines counter-clockwise, holes
/// clockwise, which do not meet but at nodes. `loops` name nodes of `points`; no node is added. Ties are
/// broken by `rank_of`. Appends counter-clockwise triangles to `triangles`. Returns false where rounding
/// would leave a triangle without positive area in double precision.
class Triangulator {
 public:
  bool triangulate(std::span<const Point> points, const Flipper::RankOf& rank_of,
                   std::span<const std::span<const std::int32_t>> loops,
                   std::vector<LocalTriangle>& triangles);

  /// The sine of the smallest angle of the triangles made last; below about 1e-11 rounding, not the outline,
  /// shaped a triangle.
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
