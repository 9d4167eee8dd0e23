#include "mesher/build/short_edges.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <utility>

#include "mesher/base/id_vector.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/geometry/segment_tree.hpp"

namespace quadloop {

namespace {

Point middle_of(const Geometry& g, std::int32_t edge) {
  return 0.5 * (g.point(edge) + g.point(g.next(edge)));
}

double length_of(const Geometry& g, std::int32_t edge) {
  return length(g.point(g.next(edge)) - g.point(edge));
}

bool in_closed_triangle(Point p, Point a, Point b, Point c) {
  const int ab = orientation(a, b, p), bc = orientation(b, c, p), ca = orientation(c, a, p);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

/// How many edges of a kind there are, and the longest of them.
struct CountedEdges {
  int count = 0;
  std::int32_t longest = 0;

  void add(const Geometry& g, std::int32_t edge) {
    if (count++ == 0 || length_of(g, edge) > length_of(g, longest)) longest = edge;
  }
};

class ShortEdges {
 public:
  ShortEdges(const Geometry& geometry, double min)
      : g_{geometry}, min_{min}, segments_{geometry}, segments_of_(geometry.boundaries().size(), 0) {
    for (std::int32_t s = 0; s < g_.size(); ++s) ++segments_of_[g_.boundary_of(s)];
  }

  /// Whether the edge is a short base, such as a blunt trailing edge: the outline runs smoothly on from both
  /// of its ends for some leaves. Where corners follow each other, as along a coast, a mesh loses some of
  /// them anyway. On a base with layers no leaf stands but columns, which need not be wider.
  bool is_short_base(std::int32_t edge) const {
    const bool has_layers = g_.boundary(g_.boundary_of(edge)).layers.has_value();
    return !has_layers && g_.kept(edge) && g_.kept(g_.next(edge)) && length_of(g_, edge) < min_ &&
           is_smooth(g_.next(edge), [&](std::int32_t v) { return g_.next(v); }) &&
           is_smooth(edge, [&](std::int32_t v) { return g_.previous(v); });
  }

  /// For a loop that a mesh keeps.
  bool can_merge(std::int32_t edge) {
    const std::int32_t loop = g_.loop_of(edge);
    const BoundaryId boundary = g_.boundary_of(edge);
    const bool is_needed = segments_of_[boundary] < 2 || g_.boundary(boundary).condition == "interface" ||
                           g_.loop_start(loop + 1) - g_.loop_start(loop) < 5;
    if (is_needed || !leaves_outline_simple(edge)) return false;
    --segments_of_[boundary];
    return true;
  }

 private:
  /// Whether no corner follows within some leaves.
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

  /// Whether neither of the segments that end in the middle of the edge touches another one, and nothing lies
  /// between them and the old ones.
  bool leaves_outline_simple(std::int32_t edge) const {
    const std::int32_t before = g_.previous(edge), after = g_.next(edge);
    const Point to = middle_of(g_, edge), from = g_.point(before), end = g_.point(g_.next(after));
    if (on_segment(end, from, to) || on_segment(from, to, end) || on_segment(to, from, end)) return false;
    Box box;
    for (const Point p : {from, g_.point(edge), g_.point(after), end}) box.include(p);
    return !segments_.any_meeting(box, [&](std::int32_t s) {
      if (s == before || s == edge || s == after) return false;
      return touches(s, from, to, g_.point(edge)) || touches(s, end, to, g_.point(after));
    });
  }

  /// Whether the segment has a point other than `fixed` in common with the triangle that the segment from
  /// `fixed` to `old` sweeps on its way to `to`.
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

/// Without the starts of the merged edges; their ends move to the middles.
Geometry with_merged(const Geometry& g, const std::vector<char>& merged) {
  std::vector<Point> points;
  std::vector<std::int32_t> starts{0};
  std::vector<BoundaryId> of_segment;
  for (std::int32_t loop = 0; loop < g.loop_count(); ++loop) {
    for (std::int32_t v = g.loop_start(loop); v < g.loop_start(loop + 1); ++v) {
      if (merged[v] != 0) continue;
      const std::int32_t before = g.previous(v);
      points.push_back(merged[before] != 0 ? middle_of(g, before) : g.point(v));
      of_segment.push_back(g.boundary_of(v));
    }
    starts.push_back(size32(points));
  }
  return {{g.boundaries().begin(), g.boundaries().end()},
          std::move(points),
          std::move(starts),
          std::move(of_segment)};
}

std::string text_of(const Geometry& g, const CountedEdges& edges, double min, const char* consequence) {
  const Point at = middle_of(g, edges.longest);
  return fmt::format(
      "{} edge{} between corners shorter than spacing.min = {:g}, the longest {:.3g} at ({:.6g}, {:.6g}) of "
      "boundary '{}': {}; make spacing.min smaller",
      edges.count, edges.count == 1 ? "" : "s", min, length_of(g, edges.longest), at.x, at.y,
      g.boundary(g.boundary_of(edges.longest)).name, consequence);
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
  std::vector<char> merged(geometry.size(), 0);
  CountedEdges joined, left;
  for (std::int32_t loop = 0; loop < geometry.loop_count(); ++loop) {
    if (is_small(geometry, loop, min)) continue;
    for (std::int32_t v = geometry.loop_start(loop); v < geometry.loop_start(loop + 1); ++v) {
      if (!edges.is_short_base(v)) continue;
      merged[v] = edges.can_merge(v) ? 1 : 0;
      (merged[v] != 0 ? joined : left).add(geometry, v);
    }
  }
  if (left.count > 0) warnings.push_back(text_of(geometry, left, min, "triangles there may be thin"));
  if (joined.count == 0) return {};
  warnings.push_back(text_of(geometry, joined, min, "the two ends became one node"));
  return with_merged(geometry, merged);
}

}  // namespace quadloop
