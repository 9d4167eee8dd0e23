#include "smoother/outline/outline_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

constexpr std::size_t most_vertices = 1000;  ///< that one chord may stand for

}  // namespace

OutlinePath::OutlinePath(const Geometry& geometry)
    : geometry_{geometry},
      arc_(geometry.size()),
      tolerance_{on_outline * std::max(geometry.box().width(), geometry.box().height())},
      segments_{segment_tree(geometry)} {
  for (std::int32_t loop = 0; loop < geometry.loop_count(); ++loop) {
    double arc = 0;
    for (std::int32_t v = geometry.loop_start(loop); v < geometry.loop_start(loop + 1); ++v) {
      arc_[v] = arc;
      arc += length(geometry.point(geometry.next(v)) - geometry.point(v));
    }
    length_.push_back(arc);
  }
}

double OutlinePath::within(std::int32_t loop, double arc) const {
  const double whole = loop_length(loop);
  if (arc < 0) arc += whole;
  return arc >= whole ? arc - whole : arc;
}

std::int32_t OutlinePath::segment_at(std::int32_t loop, double arc) const {
  const auto first = arc_.begin() + geometry_.loop_start(loop),
             last = arc_.begin() + geometry_.loop_start(loop + 1);
  return static_cast<std::int32_t>(std::upper_bound(first + 1, last, arc) - arc_.begin()) - 1;
}

/// The nearest segment of that boundary, the lowest of several; none where it is farther than `within`.
OutlinePath::Nearest OutlinePath::nearest(Point p, const std::string& boundary, double within) const {
  Nearest found{-1, within};
  const Point reach{within, within};
  segments_.for_each_meeting({p - reach, p + reach}, [&](std::int32_t s) {
    if (geometry_.boundary(geometry_.boundary_of(s)).name != boundary) return;
    const double distance = distance_to_segment(p, geometry_.point(s), geometry_.point(geometry_.next(s)));
    if (distance > found.distance || (distance == found.distance && found.segment >= 0 && s > found.segment))
      return;
    found = {s, distance};
  });
  return found;
}

bool OutlinePath::has(const std::string& boundary) const {
  const auto boundaries = geometry_.boundaries();
  return std::any_of(boundaries.begin(), boundaries.end(),
                     [&](const Boundary& b) { return b.name == boundary; });
}

double OutlinePath::distance(Point p, const std::string& boundary, double within) const {
  const Nearest found = nearest(p, boundary, within);
  return found.segment < 0 ? std::numeric_limits<double>::infinity() : found.distance;
}

OutlinePlace OutlinePath::locate(Point p, const std::string& boundary, bool also_kept) const {
  const std::int32_t segment = nearest(p, boundary, tolerance_).segment;
  if (segment < 0) return {};
  for (const std::int32_t v : {segment, geometry_.next(segment)}) {
    if (!also_kept && geometry_.kept(v) && length(p - geometry_.point(v)) <= tolerance_) return {};
  }
  const Point a = geometry_.point(segment), b = geometry_.point(geometry_.next(segment));
  const std::int32_t loop = geometry_.loop_of(segment);
  return {loop, within(loop, arc_[segment] + place_on_segment(p, a, b).parameter * length(b - a))};
}

Point OutlinePath::point_at(OutlinePlace place) const {
  const double arc = within(place.loop, place.arc);
  const std::int32_t s = segment_at(place.loop, arc);
  const Point a = geometry_.point(s), b = geometry_.point(geometry_.next(s));
  const double whole = length(b - a), along = arc - arc_[s];
  return along >= whole ? b : a + (along / whole) * (b - a);
}

double OutlinePath::way(OutlinePlace from, OutlinePlace to) const {
  return within(from.loop, to.arc - from.arc);
}

double OutlinePath::deviation(OutlinePlace from, Point a, OutlinePlace to, Point b) const {
  const double end = way(from, to), start = within(from.loop, from.arc);
  double deviation = 0;
  std::int32_t v = geometry_.next(segment_at(from.loop, start));
  for (std::size_t passed = 0; passed < most_vertices; ++passed, v = geometry_.next(v)) {
    const double arc = way({from.loop, start}, {from.loop, arc_[v]});
    if (arc >= end || (arc == 0 && passed > 0)) return deviation;
    deviation = std::max(deviation, distance_to_segment(geometry_.point(v), a, b));
  }
  return std::numeric_limits<double>::infinity();
}

/// Whether a segment is a part of the way between two places, or touches its ends a and b there.
bool OutlinePath::belongs(std::int32_t segment, OutlinePlace from, Point a, OutlinePlace to, Point b) const {
  if (geometry_.loop_of(segment) != from.loop) return false;
  const std::int32_t first = segment_at(from.loop, within(from.loop, from.arc)),
                     last = segment_at(to.loop, within(to.loop, to.arc));
  if (segment == first || segment == last) return true;
  if (segment == geometry_.previous(first) && length(geometry_.point(first) - a) <= tolerance_) return true;
  if (segment == geometry_.next(last) && length(geometry_.point(segment) - b) <= tolerance_) return true;
  return way(from, {from.loop, arc_[segment]}) <= way(from, to);
}

std::vector<std::int32_t> OutlinePath::met_elsewhere(const Chord& chord) const {
  std::vector<std::int32_t> met;
  segments_.for_each_meeting(box_of(chord.a, chord.b), [&](std::int32_t s) {
    if (belongs(s, chord.from, chord.a, chord.to, chord.b)) return;
    if (segments_meet(chord.a, chord.b, geometry_.point(s), geometry_.point(geometry_.next(s))))
      met.push_back(s);
  });
  return met;
}

bool OutlinePath::sweeps_over(const Chord& chord, Point apex) const {
  const Point a = chord.a, b = chord.b, c = apex;
  Box around = box_of(a, b);
  around.include(c);
  return segments_.any_meeting(around, [&](std::int32_t s) {
    const Point v = geometry_.point(s);
    const std::array<int, 3> turns{orientation(a, b, v), orientation(b, c, v), orientation(c, a, v)};
    const auto [least, most] = std::minmax_element(turns.begin(), turns.end());
    const bool in_triangle = *least * *most >= 0 && (*least != 0 || *most != 0);
    return in_triangle && !belongs(s, chord.from, a, chord.to, b);
  });
}

std::vector<std::int32_t> OutlinePath::segments_between(OutlinePlace from, OutlinePlace to) const {
  std::vector<std::int32_t> segments;
  const double start = within(from.loop, from.arc), end = within(to.loop, to.arc);
  const std::int32_t last = segment_at(to.loop, end);
  bool goes_round =
      end < start;  // on the way over the loop's first vertex, perhaps back to the segment where it begins
  for (std::int32_t s = segment_at(from.loop, start); segments.size() < most_vertices;
       s = geometry_.next(s)) {
    segments.push_back(s);
    if (s == last && !(goes_round && segments.size() == 1)) return segments;
  }
  return {};
}

}  // namespace quadloop
