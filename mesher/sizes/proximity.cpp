#include "mesher/sizes/proximity.hpp"

#include <algorithm>

#include "mesher/geometry/nearest_on_segment.hpp"

namespace quadloop {

namespace {

/// Two parts of the boundary face each other if the line across leaves both within 60 degrees of the normal.
constexpr double facing_cosine = 0.5;
/// Relative to the gap: if the boundary between the two sides is shorter, it is a bend, not a gap.
constexpr double bend_length = 3;
constexpr double straight_sides_degrees = 30;  ///< maximum additional turning of the two sides of a corner

/// Clips a segment to a box that it meets.
std::pair<Point, Point> clip(Point a, Point b, const Box& box) {
  double from = 0, to = 1;
  const auto limit = [&](double start, double step, double low, double high) {
    if (step == 0) return;
    const double t0 = (low - start) / step, t1 = (high - start) / step;
    from = std::max(from, std::min(t0, t1));
    to = std::min(to, std::max(t0, t1));
  };
  limit(a.x, b.x - a.x, box.low.x, box.high.x);
  limit(a.y, b.y - a.y, box.low.y, box.high.y);
  if (from > to) from = to = std::clamp(0.5 * (from + to), 0.0, 1.0);
  return {a + from * (b - a), a + to * (b - a)};
}

}  // namespace

Proximity::Proximity(const Geometry& g) : geometry_{&g}, segments_{g} {
  double arc = 0, turning = 0;
  std::int32_t kept = 0;
  for (std::int32_t v = 0; v < g.size(); ++v) {
    turning += g.kept(v) ? 0 : g.chord_turn_degrees(v);
    kept += g.kept(v) ? 1 : 0;
    arc_.push_back(arc);
    turning_.push_back(turning);
    kept_.push_back(kept);
    arc += length(g.point(g.next(v)) - g.point(v));
  }
}

/// Along the loop from p on segment a forwards to q on segment b.
bool Proximity::is_one_bend_onwards(std::int32_t a, Point p, std::int32_t b, Point q, double gap) const {
  const Geometry& g = *geometry_;
  const auto at = [](const auto& sums, std::int32_t v) { return sums[v]; };
  const std::int32_t loop = g.loop_of(a), first = g.loop_start(loop), last = g.loop_start(loop + 1) - 1;
  double arc = at(arc_, b) + length(q - g.point(b)) - at(arc_, a) - length(p - g.point(a));
  double turning = at(turning_, b) - at(turning_, a);
  std::int32_t kept = at(kept_, b) - at(kept_, a);
  if (arc < 0) {  // across the first vertex of the loop
    arc += at(arc_, last) + length(g.point(first) - g.point(last)) - at(arc_, first);
    turning += at(turning_, last) - at(turning_, first) + (g.kept(first) ? 0 : g.chord_turn_degrees(first));
    kept += at(kept_, last) - at(kept_, first) + (g.kept(first) ? 1 : 0);
  }
  return arc < bend_length * gap || (kept == 1 && turning < straight_sides_degrees);
}

bool Proximity::is_one_bend(std::int32_t a, Point p, std::int32_t b, Point q, double gap) const {
  if (geometry_->loop_of(a) != geometry_->loop_of(b)) return false;
  return is_one_bend_onwards(a, p, b, q, gap) || is_one_bend_onwards(b, q, a, p, gap);
}

bool Proximity::faces(std::int32_t a, Point a_from, Point a_to, std::int32_t b, double width) const {
  const Geometry& g = *geometry_;
  if (g.block_of(a) != g.block_of(b)) return false;  // the gap lies in one block
  const Point b_from = g.point(b), b_to = g.point(g.next(b));
  std::pair<Point, Point> across;
  double gap = width;
  const auto consider = [&](Point p, Point q) {
    if (length(q - p) >= gap) return;
    gap = length(q - p);
    across = {p, q};
  };
  for (const Point p : {a_from, a_to}) consider(p, nearest_on_segment(p, b_from, b_to));
  for (const Point q : {b_from, b_to}) consider(nearest_on_segment(q, a_from, a_to), q);
  if (gap >= width || gap == 0) return false;
  const auto [p, q] = across;
  const Point along_a = g.point(g.next(a)) - g.point(a), along_b = b_to - b_from;
  const bool left_of_a = cross(along_a, q - p) > facing_cosine * length(along_a) * gap;
  const bool left_of_b = cross(along_b, p - q) > facing_cosine * length(along_b) * gap;
  return left_of_a && left_of_b && !is_one_bend(a, p, b, q, gap);
}

bool Proximity::narrower(std::span<const std::int32_t> segments, const Box& box, double width) const {
  const Geometry& g = *geometry_;
  for (const std::int32_t a : segments) {
    const auto [from, to] = clip(g.point(a), g.point(g.next(a)), box);
    Box near = box_of(from, to);
    near.low = near.low - Point{width, width};
    near.high = near.high + Point{width, width};
    const auto faces_one = [&, a_from = from, a_to = to](std::int32_t b) {
      return b != a && faces(a, a_from, a_to, b, width);
    };
    if (segments_.any_meeting(near, faces_one)) return true;
  }
  return false;
}

Proximity::NarrowParts Proximity::narrow_parts(double width) const {
  NarrowParts parts;
  for (std::int32_t s = 0; s < geometry_->size(); ++s) {
    const Point from = geometry_->point(s), to = geometry_->point(geometry_->next(s));
    if (!narrower(std::span(&s, 1), box_of(from, to), width)) continue;
    if (parts.segments++ == 0) parts.first = from + 0.5 * (to - from);
  }
  return parts;
}

}  // namespace quadloop
