#include "mesher/geometry/shifted_outline.hpp"

#include <algorithm>
#include <cmath>

namespace quadloop {

namespace {

using Wide = long double;  // 11 more bits than the result; each operation is the same for mirrored arguments

}  // namespace

ShiftedOutline::ShiftedOutline(const Geometry& geometry) : geometry_{&geometry}, shift_(geometry.size()) {
  for (std::int32_t v = 0; v < geometry.size(); ++v) shift_[v] = shift_of(v);
}

/// The sign along one axis of the mitre at a vertex with incoming direction `in` and outgoing direction `out`
/// (signs of the components along this axis and, counter-clockwise from it, the other one), turning left
/// (+1), right (-1) or not (0); `through_peak` times a sign if either is right.
///
/// A left normal has the component -other along this axis for the x axis and +other for the y axis; `handed`
/// is that sign.
std::int8_t ShiftedOutline::mitre_sign(int in_along, int in_other, int out_along, int out_other, int turn,
                                       int handed) {
  if (in_along == 0) return static_cast<std::int8_t>(handed * in_other);
  if (out_along == 0) return static_cast<std::int8_t>(handed * out_other);
  if (in_along != out_along)
    return static_cast<std::int8_t>(turn > 0 ? out_along : in_along);  // touches the line and turns back
  const int other = in_other + out_other;
  if (in_other * out_other >= 0 && other != 0) return static_cast<std::int8_t>(handed * sign(other));
  return static_cast<std::int8_t>(-in_along * through_peak);  // both signs give the same crossing
}

ShiftedOutline::Shift ShiftedOutline::shift_of(std::int32_t vertex) const {
  const Point before = geometry_->point(geometry_->previous(vertex)), here = geometry_->point(vertex);
  const Point after = geometry_->point(geometry_->next(vertex));
  const int turn = orientation(before, here, after);
  const int in_x = sign(here.x - before.x), in_y = sign(here.y - before.y);
  const int out_x = sign(after.x - here.x), out_y = sign(after.y - here.y);
  return {mitre_sign(in_x, in_y, out_x, out_y, turn, -1), mitre_sign(in_y, in_x, out_y, out_x, turn, +1)};
}

bool ShiftedOutline::is_ahead_of_start(std::int32_t segment, Point p) const {
  const Point start = geometry_->point(segment), end = geometry_->point(geometry_->next(segment));
  return start.x != end.x ? p.x != start.x && (p.x < start.x) == (start.x < end.x)
                          : p.y != start.y && (p.y < start.y) == (start.y < end.y);
}

int ShiftedOutline::winding_at(std::int32_t segment, Point p) const {
  const bool up = beyond_y(geometry_->next(segment), p.y);
  if (up == beyond_y(segment, p.y) || has_left(segment, p) == up) return 0;
  return up ? -1 : 1;
}

int ShiftedOutline::winding_between(std::int32_t segment, Point from, Point to) const {
  const std::int32_t end = geometry_->next(segment);
  const bool crosses_line = from.y == to.y ? beyond_y(segment, to.y) != beyond_y(end, to.y)
                                           : beyond_x(segment, to.x) != beyond_x(end, to.x);
  return crosses_line ? has_left(segment, to) - has_left(segment, from) : 0;
}

bool ShiftedOutline::meets(std::int32_t segment, const Box& box) const {
  const std::int32_t end = geometry_->next(segment);
  const Point a = geometry_->point(segment), b = geometry_->point(end);
  if (std::max(a.x, b.x) < box.low.x || std::min(a.x, b.x) > box.high.x || std::max(a.y, b.y) < box.low.y ||
      std::min(a.y, b.y) > box.high.y) {
    return false;
  }
  const bool a_right = beyond_x(segment, box.low.x), b_right = beyond_x(end, box.low.x);
  if (!a_right && !b_right) return false;
  const bool a_far_right = beyond_x(segment, box.high.x), b_far_right = beyond_x(end, box.high.x);
  if (a_far_right && b_far_right) return false;
  const bool a_above = beyond_y(segment, box.low.y), b_above = beyond_y(end, box.low.y);
  if (!a_above && !b_above) return false;
  const bool a_far_above = beyond_y(segment, box.high.y), b_far_above = beyond_y(end, box.high.y);
  if (a_far_above && b_far_above) return false;
  if (a_right && !a_far_right && a_above && !a_far_above) return true;
  if (b_right && !b_far_right && b_above && !b_far_above) return true;
  const bool side = has_left(segment, box.low);
  return has_left(segment, {box.high.x, box.low.y}) != side || has_left(segment, box.high) != side ||
         has_left(segment, {box.low.x, box.high.y}) != side;
}

double crossing_height(Point a, Point b, double x) {
  // Both on the line: any point of the segment is valid, and callers avoid this case.
  if (a.x == x) return a.y;
  if (b.x == x) return b.y;
  const double to_a = std::abs(x - a.x), to_b = std::abs(x - b.x);
  if (to_a > to_b) std::swap(a, b);  // from the nearer end
  const Wide run = Wide(b.x) - a.x, rise = Wide(b.y) - a.y;
  if (to_a == to_b)
    return static_cast<double>((Wide(a.y) + b.y) / 2 + (Wide(x) - (Wide(a.x) + b.x) / 2) * rise / run);
  return static_cast<double>(a.y + (Wide(x) - a.x) * rise / run);
}

}  // namespace quadloop
