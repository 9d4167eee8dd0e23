#include "mesher/layers/front/strip_room.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "mesher/base/error.hpp"
#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/geometry/validate.hpp"

namespace quadloop {

namespace {

/// Whether a closed polyline encloses a point.
bool goes_round(std::span<const Point> ring, Point p) {
  bool inside = false;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Point a = ring[k], b = ring[(k + 1) % ring.size()];
    if ((a.y > p.y) != (b.y > p.y) && (cross(b - a, p - a) > 0) == (b.y > a.y)) inside = !inside;
  }
  return inside;
}

bool is_in_domain(const Geometry& g, Point p) {
  bool inside = false;
  for (std::int32_t loop = 0; loop < g.loop_count(); ++loop) {
    const std::int32_t begin = g.loop_start(loop);
    if (goes_round(g.points().subspan(begin, g.loop_start(loop + 1) - begin), p)) inside = !inside;
  }
  return inside;
}

/// The strip whose front contains a segment of the outer geometry.
const LayerStrip& strip_at(const LayerFront& front, std::int32_t s) {
  const Point p = front.outer.point(s);
  return *std::ranges::find_if(front.strips, [&](const LayerStrip& strip) {
    return (strip.root && strip.root->left == p) || std::ranges::find(strip.front, p) != strip.front.end();
  });
}

/// The common point of two crossing segments, up to rounding.
Point common_point(Point a, Point b, Point c, Point d) {
  const double slope = cross(b - a, d - c);
  return slope == 0 ? c : a + (cross(c - a, d - c) / slope) * (b - a);
}

/// A place where a strip's front touches something else.
struct Meeting {
  std::int32_t segment = 0, other = 0;  ///< of the outer geometry
  Point at;
};

/// The midpoint of a strip's first column.
Point beginning_of(const LayerStrip& strip) { return strip.columns[0][strip.columns[0].size() / 2]; }

/// All contacts in the order of segments, except those of consecutive segments.
std::vector<Meeting> meetings_of_strips(const LayerFront& front) {
  const Geometry& g = front.outer;
  std::vector<Box> boxes;
  for (std::int32_t s = 0; s < g.size(); ++s) boxes.push_back(box_of(g.point(s), g.point(g.next(s))));
  const BoxTree tree(boxes);
  std::vector<Meeting> meetings;
  for (std::int32_t s = 0; s < g.size(); ++s) {
    if (g.boundary_of(s) != front.strip_boundary()) continue;
    const Point a = g.point(s), b = g.point(g.next(s));
    tree.for_each_meeting(boxes[s], [&](std::int32_t t) {
      if (t == s || t == g.next(s) || t == g.previous(s)) return;
      const Point c = g.point(t), d = g.point(g.next(t));
      if (segments_meet(a, b, c, d)) meetings.push_back({s, t, common_point(a, b, c, d)});
    });
  }
  return meetings;
}

/// Reports the strip of the first contact, at its contact nearest to the strip's beginning.
[[noreturn]] void refuse_meeting(const LayerFront& front, const std::vector<Meeting>& meetings) {
  const LayerStrip& strip = strip_at(front, meetings[0].segment);
  const Point begin = beginning_of(strip);
  Meeting nearest = meetings[0];
  for (const Meeting& meeting : meetings) {
    if (length(meeting.at - begin) < length(nearest.at - begin) &&
        &strip_at(front, meeting.segment) == &strip)
      nearest = meeting;
  }
  const BoundaryId boundary = front.outer.boundary_of(nearest.other);
  const bool itself = boundary == front.strip_boundary() && &strip_at(front, nearest.other) == &strip;
  const std::string what = itself ? "themselves"
                           : boundary == front.strip_boundary()
                               ? "those of " + strip_at(front, nearest.other).name
                               : "boundary " + front.outer.boundary(boundary).name;
  throw InputError(fmt::format(
      "{}the layers of {}, which begins at ({:.6g}, {:.6g}), meet {} at ({:.6g}, {:.6g}), {:.3g} from there; "
      "shorten it, change its path, or use fewer or thinner layers or a smaller spacing along it",
      strip.place, strip.name, begin.x, begin.y, what, nearest.at.x, nearest.at.y,
      length(nearest.at - begin)));
}

/// Checks that the fronts of strips touch neither anything else nor themselves.
void require_disjoint(const LayerFront& front) {
  if (!front.has_strips()) return;
  const std::vector<Meeting> meetings = meetings_of_strips(front);
  if (!meetings.empty()) refuse_meeting(front, meetings);
}

/// The outer geometry as an Outline, the input of the sweep over loops.
Outline as_outline(const Geometry& g) {
  Outline outline;
  for (const Boundary& boundary : g.boundaries()) outline.names.push_back(boundary.name);
  for (std::int32_t loop = 0; loop < g.loop_count(); ++loop) {
    OutlineLoop& to = outline.loops.emplace_back();
    for (std::int32_t v = g.loop_start(loop); v < g.loop_start(loop + 1); ++v) {
      to.points.push_back(g.point(v));
      to.boundary.push_back(g.boundary_of(v));
    }
  }
  return outline;
}

/// The segment nearest to p on the fronts of a loop, or on the fronts of strips only. All loops if `loop` is
/// -1: a point between the outer boundary and its front is in no loop.
std::int32_t nearest_front(const LayerFront& front, std::int32_t loop, Point p, bool strips_alone) {
  const Geometry& g = front.outer;
  const std::int32_t begin = loop < 0 ? 0 : g.loop_start(loop),
                     end = loop < 0 ? g.size() : g.loop_start(loop + 1);
  std::int32_t nearest = begin;
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t s = begin; s < end; ++s) {
    if (strips_alone ? g.boundary_of(s) != front.strip_boundary() : !front.is_front(s)) continue;
    const double distance = place_on_segment(p, g.point(s), g.point(g.next(s))).squared_distance;
    if (distance >= least) continue;
    least = distance;
    nearest = s;
  }
  return nearest;
}

/// Reports a boundary that is enclosed by the layers of a line.
[[noreturn]] void refuse_body_within(const LayerFront& front, std::int32_t loop, std::int32_t parent) {
  const Geometry& g = front.line.geometry();
  const std::int32_t begin = g.loop_start(loop);
  const Point p = g.point(begin);
  const LayerStrip& strip = strip_at(front, nearest_front(front, parent, p, true));
  throw InputError(
      fmt::format("{}the layers of {} cover boundary {} at ({:.6g}, {:.6g}); change its path, or shorten it",
                  strip.place, strip.name, g.boundary(g.boundary_of(begin)).name, p.x, p.y));
}

/// Reports a free line outside the domain, or within the layers of another loop.
[[noreturn]] void refuse_line(const LayerFront& front, std::int32_t loop, std::int32_t parent) {
  const std::int32_t begin = front.outer.loop_start(loop);
  const Point p = front.outer.point(begin);
  const LayerStrip& strip = strip_at(front, begin);
  if (!is_in_domain(front.line.geometry(), p))
    throw InputError(fmt::format("{}{} lies outside of the domain, at ({:.6g}, {:.6g}); change its path",
                                 strip.place, strip.name, p.x, p.y));
  const std::int32_t around = nearest_front(front, parent, p, false);
  const BoundaryId boundary = front.outer.boundary_of(around);
  const std::string whose = boundary == front.strip_boundary()
                                ? strip_at(front, around).name
                                : "boundary " + front.outer.boundary(boundary).name;
  throw InputError(fmt::format(
      "{}{} lies within the layers of {}, at ({:.6g}, {:.6g}); change its path, or make those layers thinner",
      strip.place, strip.name, whose, p.x, p.y));
}

/// Checks that every loop of the outer geometry has the domain to its left: no body and no line lies within
/// the layers of another one. Call after require_disjoint().
void require_room(const LayerFront& front) {
  if (!front.has_strips()) return;
  const std::vector<LoopNesting> nestings = validate(as_outline(front.outer));
  for (std::size_t loop = 0; loop < nestings.size(); ++loop) {
    const LoopNesting& nesting = nestings[loop];
    if (nesting.counter_clockwise == (nesting.depth % 2 == 0)) continue;
    const auto at = static_cast<std::int32_t>(loop);
    if (at < front.line.geometry().loop_count()) refuse_body_within(front, at, nesting.parent);
    refuse_line(front, at, nesting.parent);
  }
}

}  // namespace

void require_room_for_strips(const LayerFront& front) {
  require_disjoint(front);
  require_room(front);
}

}  // namespace quadloop
