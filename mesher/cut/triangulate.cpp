#include "mesher/cut/triangulate.hpp"

#include <algorithm>

#include "mesher/cut/hole_triangulation.hpp"

namespace quadloop {

namespace {

/// Maximum number of nodes for ear clipping, which takes quadratic time.
constexpr std::size_t most_ears = 24;

/// The edges that loops pass in both directions.
std::vector<Flipper::Ends> twofold_edges(std::span<const std::span<const std::int32_t>> loops) {
  std::vector<Flipper::Ends> edges;
  if (loops.size() == 1) return edges;
  for (const auto loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto [low, high] = std::minmax({loop[i], loop[(i + 1) % loop.size()]});
      edges.push_back({low, high});
    }
  }
  std::ranges::sort(edges);
  std::vector<Flipper::Ends> twofold;
  for (std::size_t i = 1; i < edges.size(); ++i) {
    if (edges[i] == edges[i - 1]) twofold.push_back(edges[i]);
  }
  return twofold;
}

}  // namespace

bool Triangulator::triangulate(std::span<const Point> points, const Flipper::RankOf& rank_of,
                               std::span<const std::span<const std::int32_t>> loops,
                               std::vector<LocalTriangle>& triangles) {
  points_ = points;
  triangles_.clear();
  const bool clipped = loops.size() == 1 && loops[0].size() <= most_ears && clip_ears(loops[0]);
  if (!clipped) {
    triangles_.clear();
    triangulate_region(points, loops, triangles_);
  }
  flipper_.keep(twofold_edges(loops));
  if (triangles_.size() > 1) flipper_.flip_to_delaunay(points, rank_of, triangles_);
  for (LocalTriangle& t : triangles_) {
    if (!is_positive(at(t[0]), at(t[1]), at(t[2]))) return false;
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  }
  measure();
  // the order must not depend on how the triangles were found
  std::sort(triangles_.begin(), triangles_.end());
  triangles.insert(triangles.end(), triangles_.begin(), triangles_.end());
  return true;
}

void Triangulator::measure() {
  smallest_sine_ = 1;
  for (const LocalTriangle& t : triangles_) {
    const Point a = at(t[0]), b = at(t[1]), c = at(t[2]);
    const double ab = length(b - a), bc = length(c - b), ca = length(a - c);
    smallest_sine_ = std::min(smallest_sine_, cross(b - a, c - a) * std::min({ab, bc, ca}) / (ab * bc * ca));
  }
}

bool Triangulator::is_ear(std::size_t i) const {
  const std::size_t n = ring_.size();
  const std::int32_t a = ring_[(i + n - 1) % n], b = ring_[i], c = ring_[(i + 1) % n];
  if (!is_positive(at(a), at(b), at(c))) return false;
  for (const std::int32_t other : ring_) {
    if (other == a || other == b || other == c) continue;
    const Point p = at(other);
    if (orientation(at(a), at(b), p) >= 0 && orientation(at(b), at(c), p) >= 0 &&
        orientation(at(c), at(a), p) >= 0)
      return false;
  }
  return true;
}

bool Triangulator::clip_ears(std::span<const std::int32_t> loop) {
  ring_.assign(loop.begin(), loop.end());
  while (ring_.size() > 3) {
    std::size_t i = 0;
    while (i < ring_.size() && !is_ear(i)) ++i;
    if (i == ring_.size()) return false;
    const std::size_t n = ring_.size();
    triangles_.push_back({ring_[(i + n - 1) % n], ring_[i], ring_[(i + 1) % n]});
    ring_.erase(ring_.begin() + i);
  }
  triangles_.push_back({ring_[0], ring_[1], ring_[2]});
  return true;
}

}  // namespace quadloop
