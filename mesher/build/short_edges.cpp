#include "mesher/build/short_edges.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <span>
#include <utility>

#include "mesher/base/id_vector.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/geometry/segment_tree.hpp"

namespace quadloop {

namespace {

/// A part of the geometry between two consecutive feature points.
struct Base {
  std::int32_t first = 0, last = 0;  ///< vertices at its ends
};

Point middle_of(const Geometry& g, Base base) { return 0.5 * (g.point(base.first) + g.point(base.last)); }

double width_of(const Geometry& g, Base base) { return length(g.point(base.last) - g.point(base.first)); }

bool in_closed_triangle(Point p, Point a, Point b, Point c) {
  const int ab = orientation(a, b, p), bc = orientation(b, c, p), ca = orientation(c, a, p);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

/// Number of bases of a kind, with the widest of them.
struct CountedBases {
  int count = 0;
  Base widest;

  void add(const Geometry& g, Base base) {
    if (count++ == 0 || width_of(g, base) > width_of(g, widest)) widest = base;
  }
};

class ShortEdges {
 public:
  ShortEdges(const Geometry& geometry, double min)
      : g_{geometry}, min_{min}, segments_{geometry}, segments_of_(geometry.boundaries().size(), 0) {
    for (std::int32_t s = 0; s < g_.size(); ++s) ++segments_of_[g_.boundary_of(s)];
  }

  /// Returns the short base that starts at the vertex, e.g. a blunt trailing edge: the boundary continues
  /// smoothly from both of its ends for some leaf sizes. With consecutive feature points, as along a coast, a
  /// mesh loses some of them anyway. A base with layers has columns instead of leaves, whose width is not
  /// limited.
  std::optional<Base> short_base_at(std::int32_t v) const {
    if (!g_.kept(v) || g_.boundary(g_.boundary_of(v)).layers) return {};
    const std::optional<Geometry::Stretch> stretch = g_.stretch_shorter_than(min_, v);
    if (!stretch || !is_smooth(stretch->end, [&](std::int32_t u) { return g_.next(u); }) ||
        !is_smooth(v, [&](std::int32_t u) { return g_.previous(u); }))
      return {};
    return Base{v, stretch->end};
  }

  /// Whether the ends can be merged, for a loop that the mesh keeps.
  bool can_merge(Base base) {
    const std::int32_t loop = g_.loop_of(base.first), segments = segments_in(base);
    const BoundaryId boundary = g_.boundary_of(base.first);
    const bool is_needed = segments_of_[boundary] <= segments ||
                           g_.boundary(boundary).condition == BoundaryCondition::interface ||
                           g_.loop_start(loop + 1) - g_.loop_start(loop) < 4 + segments;
    if (is_needed || !leaves_outline_simple(base)) return false;
    segments_of_[boundary] -= segments;
    return true;
  }

 private:
  /// Whether there is no feature point within four leaf sizes.
  template <class Next>
  bool is_smooth(std::int32_t from, const Next& next) const {
    constexpr double leaves = 4;
    double way = 0;
    for (std::int32_t v = from; way < leaves * min_; v = next(v)) {
      if (v != from && g_.kept(v)) return false;
      way += length(g_.point(next(v)) - g_.point(v));
    }
    return true;
  }

  std::int32_t segments_in(Base base) const {
    std::int32_t count = 0;
    for (std::int32_t v = base.first; v != base.last; v = g_.next(v)) ++count;
    return count;
  }

  bool is_in(Base base, std::int32_t segment) const {
    for (std::int32_t v = base.first; v != base.last; v = g_.next(v)) {
      if (v == segment) return true;
    }
    return false;
  }

  /// Whether the two segments that would end in the middle of the base touch no other segment, and nothing
  /// lies between them and the old ones.
  bool leaves_outline_simple(Base base) const {
    const std::int32_t before = g_.previous(base.first), after = base.last;
    const Point to = middle_of(g_, base), from = g_.point(before), end = g_.point(g_.next(after));
    if (on_segment(end, from, to) || on_segment(from, to, end) || on_segment(to, from, end)) return false;
    Box box;
    box.include(from);
    box.include(end);
    for (std::int32_t v = base.first; v != base.last; v = g_.next(v)) box.include(g_.point(v));
    box.include(g_.point(base.last));
    return !segments_.any_meeting(box, [&](std::int32_t s) {
      if (s == before || s == after || is_in(base, s)) return false;
      return touches(s, from, to, g_.point(base.first)) || touches(s, end, to, g_.point(after)) ||
             is_between(s, base, to);
    });
  }

  /// Whether the segment meets the triangles between the base's own segments and `to`.
  bool is_between(std::int32_t segment, Base base, Point to) const {
    const Point a = g_.point(segment), b = g_.point(g_.next(segment));
    for (std::int32_t v = base.first; v != base.last; v = g_.next(v)) {
      const Point p = g_.point(v), q = g_.point(g_.next(v));
      if (in_closed_triangle(a, p, q, to) || segments_meet(a, b, q, to)) return true;
    }
    return false;
  }

  /// Whether the segment meets, at a point other than `fixed`, the triangle swept by the segment from `fixed`
  /// to `old` as its end moves to `to`.
  bool touches(std::int32_t segment, Point fixed, Point to, Point old) const {
    const Point a = g_.point(segment), b = g_.point(g_.next(segment));
    if (a != fixed && in_closed_triangle(a, fixed, old, to)) return true;
    if (b != fixed && in_closed_triangle(b, fixed, old, to)) return true;
    if (a == fixed || b == fixed) return segments_meet(a, b, old, to);
    return segments_meet(a, b, fixed, to);
  }

  const Geometry& g_;
  double min_;
  SegmentTree segments_;
  IdVector<BoundaryId, std::int32_t> segments_of_;
};

/// Returns the geometry without the vertices of the merged bases except the last one, which moves to the
/// middle.
Geometry with_merged(const Geometry& g, std::span<const Base> bases) {
  std::vector<char> is_dropped(g.size(), 0);
  std::vector<Point> moved{g.points().begin(), g.points().end()};
  for (const Base base : bases) {
    for (std::int32_t v = base.first; v != base.last; v = g.next(v)) is_dropped[v] = 1;
    moved[base.last] = middle_of(g, base);
  }
  std::vector<Point> points;
  std::vector<std::int32_t> starts{0};
  std::vector<BoundaryId> of_segment;
  for (std::int32_t loop = 0; loop < g.loop_count(); ++loop) {
    for (std::int32_t v = g.loop_start(loop); v < g.loop_start(loop + 1); ++v) {
      if (is_dropped[v] != 0) continue;
      points.push_back(moved[v]);
      of_segment.push_back(g.boundary_of(v));
    }
    starts.push_back(size32(points));
  }
  return {{g.boundaries().begin(), g.boundaries().end()},
          std::move(points),
          std::move(starts),
          std::move(of_segment)};
}

std::string text_of(const Geometry& g, const CountedBases& bases, double min, const char* consequence) {
  const Point at = middle_of(g, bases.widest);
  return fmt::format(
      "{} edge{} between corners shorter than spacing.min = {:g}, the longest {:.3g} at ({:.6g}, {:.6g}) of "
      "boundary '{}': {}; make spacing.min smaller",
      bases.count, bases.count == 1 ? "" : "s", min, width_of(g, bases.widest), at.x, at.y,
      g.boundary(g.boundary_of(bases.widest.first)).name, consequence);
}

bool is_small(const Geometry& g, std::int32_t loop, double min) {
  Box box;
  for (std::int32_t v = g.loop_start(loop); v < g.loop_start(loop + 1); ++v) box.include(g.point(v));
  return box.width() < min && box.height() < min;
}

}  // namespace

std::optional<Geometry> short_edges_merged(const Geometry& geometry, double min,
                                           std::vector<std::string>& warnings) {
  ShortEdges edges(geometry, min);
  std::vector<Base> merged;
  CountedBases joined, left;
  for (std::int32_t loop = 0; loop < geometry.loop_count(); ++loop) {
    if (is_small(geometry, loop, min)) continue;
    for (std::int32_t v = geometry.loop_start(loop); v < geometry.loop_start(loop + 1); ++v) {
      const std::optional<Base> base = edges.short_base_at(v);
      if (!base) continue;
      const bool can_merge = edges.can_merge(*base);
      if (can_merge) merged.push_back(*base);
      (can_merge ? joined : left).add(geometry, *base);
    }
  }
  if (left.count > 0) warnings.push_back(text_of(geometry, left, min, "triangles there may be thin"));
  if (merged.empty()) return {};
  warnings.push_back(text_of(geometry, joined, min, "the two ends became one node"));
  return with_merged(geometry, merged);
}

}  // namespace quadloop
