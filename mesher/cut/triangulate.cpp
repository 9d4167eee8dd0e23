#include "mesher/cut/triangulate.hpp"

#include <algorithm>

#include "mesher/cut/hole_triangulation.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

constexpr std::size_t most_ears =
    24;  ///< nodes; beyond, clipping ears in square time loses to a real triangulation

std::int64_t name_of(std::int32_t a, std::int32_t b) {
  return (std::int64_t{std::min(a, b)} << 32) | std::max(a, b);
}

}  // namespace

bool Triangulator::triangulate(std::span<const Point> points, std::span<const TieKey> keys,
                               std::span<const std::span<const std::int32_t>> loops,
                               std::vector<LocalTriangle>& triangles) {
  points_ = points;
  keys_ = keys;
  triangles_.clear();
  const bool clipped = loops.size() == 1 && loops[0].size() <= most_ears && clip_ears(loops[0]);
  if (!clipped) {
    triangles_.clear();
    triangulate_region(points, loops, triangles_);
  }
  if (triangles_.size() > 1) flip_to_delaunay(loops);
  for (LocalTriangle& t : triangles_) {
    if (!positive(t[0], t[1], t[2])) return false;
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  }
  measure();
  std::sort(triangles_.begin(), triangles_.end());  // the order must not tell how the triangles were found
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

/// Positive exactly, and by the plain products in doubles that every reader of the mesh will use, at each
/// corner.
bool Triangulator::positive(std::int32_t a, std::int32_t b, std::int32_t c) const {
  const Point p = at(a), q = at(b), r = at(c);
  return cross(q - p, r - p) > 0 && cross(r - q, p - q) > 0 && cross(p - r, q - r) > 0 &&
         orientation(p, q, r) > 0;
}

bool Triangulator::is_ear(std::size_t i) const {
  const std::size_t n = ring_.size();
  const std::int32_t a = ring_[(i + n - 1) % n], b = ring_[i], c = ring_[(i + 1) % n];
  if (!positive(a, b, c)) return false;
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
    ring_.erase(ring_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  triangles_.push_back({ring_[0], ring_[1], ring_[2]});
  return true;
}

void Triangulator::flip_to_delaunay(std::span<const std::span<const std::int32_t>> loops) {
  fixed_.clear();
  for (const auto loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i)
      fixed_.push_back({name_of(loop[i], loop[(i + 1) % loop.size()]), -1, 0});
  }
  std::size_t passes = 4 * points_.size() + 16;
  while (flip_pass() && --passes > 0) {
  }
}

/// Flips what is not Delaunay, each triangle once at most. Whether anything was flipped.
bool Triangulator::flip_pass() {
  half_edges_ = fixed_;
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      half_edges_.push_back({name_of(triangles_[t][(k + 1) % 3], triangles_[t][(k + 2) % 3]),
                             static_cast<std::int32_t>(t), static_cast<std::int32_t>(k)});
    }
  }
  std::sort(half_edges_.begin(), half_edges_.end(), [](const HalfEdge& e, const HalfEdge& f) {
    return e.name != f.name ? e.name < f.name : e.triangle < f.triangle;
  });
  touched_.assign(triangles_.size(), 0);
  bool any = false;
  for (std::size_t i = 0; i + 1 < half_edges_.size(); ++i) {
    const HalfEdge e = half_edges_[i], f = half_edges_[i + 1];
    const bool starts = i == 0 || half_edges_[i - 1].name != e.name;
    if (!starts || e.name != f.name || e.triangle < 0) continue;
    const auto s = static_cast<std::size_t>(e.triangle), t = static_cast<std::size_t>(f.triangle);
    if (touched_[s] != 0 || touched_[t] != 0) continue;
    const auto k = static_cast<std::size_t>(e.corner);
    const std::int32_t c = triangles_[s][k], a = triangles_[s][(k + 1) % 3], b = triangles_[s][(k + 2) % 3];
    const std::int32_t d = triangles_[t][static_cast<std::size_t>(f.corner)];
    if (!should_flip(a, b, c, d)) continue;
    triangles_[s] = {a, d, c};
    triangles_[t] = {d, b, c};
    touched_[s] = touched_[t] = 1;
    any = true;
  }
  return any;
}

/// Whether the edge a-b between the triangles a b c and b a d should give way to c-d.
bool Triangulator::should_flip(std::int32_t a, std::int32_t b, std::int32_t c, std::int32_t d) const {
  const int inside = in_circle(at(a), at(b), at(c), at(d));
  if (inside < 0) return false;
  if (inside == 0) {
    const auto key = [&](std::int32_t n) -> const TieKey& { return keys_[static_cast<std::size_t>(n)]; };
    const auto with = std::max(key(c), key(d)), without = std::max(key(a), key(b));
    if (!(with > without)) return false;
  }
  return positive(a, d, c) && positive(d, b, c);
}

}  // namespace quadloop
