#include "smoother/outline/outline_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop::smoother {

namespace {

constexpr std::size_t usually_near = 16;  ///< usual number of near segments
constexpr int short_walk = 8;             ///< in segments; farther places are found by search

}  // namespace

OutlinePath::OutlinePath(const Geometry& geometry)
    : geometry_{geometry},
      arc_(geometry.size()),
      tolerance_{on_outline * std::max(geometry.box().width(), geometry.box().height())},
      segments_{geometry} {
  for (std::int32_t loop = 0; loop < geometry.loop_count(); ++loop) {
    double arc = 0;
    for (std::int32_t v = geometry.loop_start(loop); v < geometry.loop_start(loop + 1); ++v) {
      arc_[v] = arc;
      arc += length(geometry.point(geometry.next(v)) - geometry.point(v));
    }
    length_.push_back(arc);
  }
  for (std::int32_t s = 0; geometry.has_curves() && s < geometry.size(); ++s)
    height_ = std::max(height_, height_of_hull(geometry.segment(s)));
}

std::int32_t OutlinePath::segment_at(std::int32_t loop, double arc) const {
  const auto first = arc_.begin() + geometry_.loop_start(loop),
             last = arc_.begin() + geometry_.loop_start(loop + 1);
  return static_cast<std::int32_t>(std::upper_bound(first + 1, last, arc) - arc_.begin()) - 1;
}

OutlinePlace OutlinePath::place_at(std::int32_t loop, double arc) const {
  const double inside = within(loop, arc);
  return {inside, loop, segment_at(loop, inside)};
}

OutlinePlace OutlinePath::moved(const OutlinePlace& from, double step) const {
  const double arc = within(from.loop, from.arc + step);
  std::int32_t s = from.segment;
  for (int walked = 0; walked < short_walk; ++walked) {
    if (line_of(s).holds(arc)) return {arc, from.loop, s};
    s = step < 0 ? geometry_.previous(s) : geometry_.next(s);
  }
  return place_at(from.loop, arc);
}

void OutlinePath::points_at(const OutlinePlace& from, std::span<const double> steps,
                            std::span<Point> points) const {
  const Line line = line_of(from.segment);
  const bool straight = !geometry_.is_curved(from.segment);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const double arc = within(from.loop, from.arc + steps[k]);
    points[k] = straight && line.holds(arc) ? line.point_at(arc) : point_at(moved(from, steps[k]));
  }
}

OutlinePath::Segments OutlinePath::segments_near(Box box) const {
  Segments segments;
  segments.reserve(usually_near);
  find_segments_near(box, segments);
  return segments;
}

void OutlinePath::find_segments_near(Box box, Segments& near) const {
  near.clear();
  segments_.for_each_meeting(widened(box, tolerance_ + height_), [&](std::int32_t s) { near.push_back(s); });
}

/// The nearest segment of that boundary, the lowest index of equal ones; none if farther than `within`.
OutlinePath::Nearest OutlinePath::nearest(Point p, const std::string& boundary, double within,
                                          std::span<const std::int32_t> near) const {
  Nearest found{-1, within};
  const Box reach = widened({p, p}, within + height_);
  for (const std::int32_t s : near) {
    if (!box_of_segment(s).meets(reach) || !is_of(s, boundary) || returns(s)) continue;
    const double distance = distance_to(s, p);
    if (distance > found.distance || (distance == found.distance && found.segment >= 0 && s > found.segment))
      continue;
    found = {s, distance};
  }
  return found;
}

double OutlinePath::distance_to(std::int32_t segment, Point p) const {
  if (geometry_.is_curved(segment)) return length(p - geometry_.on_curve(segment, p));
  return distance_to_segment(p, geometry_.point(segment), geometry_.point(geometry_.next(segment)));
}

bool OutlinePath::has(const std::string& boundary) const {
  const auto boundaries = geometry_.boundaries();
  return std::any_of(boundaries.begin(), boundaries.end(),
                     [&](const Boundary& b) { return b.name == boundary; });
}

double OutlinePath::distance(Point p, const std::string& boundary, double within) const {
  const Nearest found = nearest(p, boundary, within, segments_near(widened({p, p}, within)));
  return found.segment < 0 ? std::numeric_limits<double>::infinity() : found.distance;
}

OutlinePlace OutlinePath::locate(Point p, const std::string& boundary,
                                 std::span<const std::int32_t> near) const {
  const std::int32_t segment = nearest(p, boundary, tolerance_, near).segment;
  if (segment < 0) return {};
  const Point a = geometry_.point(segment), b = geometry_.point(geometry_.next(segment));
  const std::int32_t loop = geometry_.loop_of(segment);
  const OutlinePlace start{arc_[segment], loop, segment};
  OutlinePlace place = moved(start, place_on_segment(p, a, b).parameter * length(b - a));
  for (const std::int32_t v : {segment, geometry_.next(segment)})
    place.kept = place.kept || (geometry_.kept(v) && length(p - geometry_.point(v)) <= tolerance_);
  return place;
}

double OutlinePath::deviation(const OutlinePlace& from, Point a, const OutlinePlace& to, Point b) const {
  const double end = way(from, to);
  double deviation = 0;
  std::int32_t v = geometry_.next(from.segment);
  for (std::size_t passed = 0; passed < most_vertices; ++passed, v = geometry_.next(v)) {
    const double arc = within(from.loop, arc_[v] - from.arc);
    if (arc >= end || (arc == 0 && passed > 0)) return deviation;
    deviation = std::max(deviation, distance_to_segment(geometry_.point(v), a, b));
  }
  return std::numeric_limits<double>::infinity();
}

OutlinePath::Part OutlinePath::part_of(const Chord& chord) const {
  Part part;
  part.way = way(chord.from, chord.to);
  const std::int32_t first = chord.from.segment, after = geometry_.next(chord.to.segment);
  if (length(geometry_.point(first) - chord.a) <= tolerance_) part.before = geometry_.previous(first);
  if (length(geometry_.point(after) - chord.b) <= tolerance_) part.after = after;
  return part;
}

/// Whether a segment belongs to the part that the chord represents, or touches the chord's ends there. Fast
/// path: most queried segments contain an end.
bool OutlinePath::belongs(std::int32_t segment, const Chord& chord) const {
  if (returns(segment)) segment = geometry_.twin(segment);
  if (segment == chord.from.segment || segment == chord.to.segment) return true;
  const Part part = part_of(chord);
  if (segment == part.before || segment == part.after) return true;
  const std::int32_t loop = chord.from.loop;
  return geometry_.loop_of(segment) == loop && within(loop, arc_[segment] - chord.from.arc) <= part.way;
}

/// Whether a segment of the outline or of an inner line begins or ends at an end of the chord, where lines
/// branch, and leads away from the chord.
bool OutlinePath::branches_off(std::int32_t segment, const Chord& chord) const {
  if (!geometry_.has_inner_lines()) return false;
  const Point p = geometry_.point(segment), q = geometry_.point(geometry_.next(segment));
  const auto leads_away = [](Point hub, Point a, Point b) {
    return orientation(hub, a, b) != 0 || dot(a - hub, b - hub) < 0;
  };
  if (p == chord.a) return leads_away(p, q, chord.b);
  if (p == chord.b) return leads_away(p, q, chord.a);
  if (q == chord.a) return leads_away(q, p, chord.b);
  return q == chord.b && leads_away(q, p, chord.a);
}

OutlinePath::Segments OutlinePath::met_elsewhere(const Chord& chord,
                                                 std::span<const std::int32_t> near) const {
  Segments met;
  const Box around = box_of(chord.a, chord.b);
  for (const std::int32_t s : near) {
    if (box_of_segment(s).meets(around) && !belongs(s, chord) && !branches_off(s, chord) &&
        segments_meet(chord.a, chord.b, geometry_.point(s), geometry_.point(geometry_.next(s))))
      met.push_back(s);
  }
  return met;
}

bool OutlinePath::sweeps_over(const Chord& chord, Point apex, std::span<const std::int32_t> near) const {
  const Point a = chord.a, b = chord.b, c = apex;
  const Box around = box_round(chord, apex);
  return std::ranges::any_of(near, [&](std::int32_t s) {
    const Point v = geometry_.point(s);
    if (!around.contains(v) || belongs(s, chord)) return false;
    const std::array<int, 3> turns{orientation(a, b, v), orientation(b, c, v), orientation(c, a, v)};
    const auto [least, most] = std::minmax_element(turns.begin(), turns.end());
    return *least * *most >= 0 && (*least != 0 || *most != 0);
  });
}

OutlinePath::Segments OutlinePath::segments_between(const OutlinePlace& from, const OutlinePlace& to) const {
  Segments segments;
  if (!walk(from, to, [&](std::int32_t s) { segments.push_back(s); })) segments.clear();
  return segments;
}

}  // namespace quadloop::smoother
