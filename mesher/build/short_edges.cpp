#include "mesher/build/short_edges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <span>
#include <utility>

#include "mesher/base/id_vector.hpp"
#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/geometry/segment_tree.hpp"

namespace quadloop {

namespace {

/// The part of a boundary between two consecutive feature points, shorter than `min`.
struct ShortEdge {
  std::int32_t first = 0, last = 0;  ///< vertices at its ends
  double length = 0;
};

/// Consecutive short edges of one boundary, shorter than `min` in total.
struct Base : ShortBase {
  std::span<const ShortEdge> edges;
};

Point middle_of(const Geometry& g, std::int32_t first, std::int32_t last) {
  return 0.5 * (g.point(first) + g.point(last));
}

bool begins_another_boundary(const Geometry& g, std::int32_t v) {
  return g.boundary_of(v) != g.boundary_of(g.previous(v));
}

/// Whether p lies in the closed triangle, which may be a segment.
bool in_closed_triangle(Point p, Point a, Point b, Point c) {
  Box box = box_of(a, b);
  box.include(c);
  if (!box.contains(p)) return false;
  const int ab = orientation(a, b, p), bc = orientation(b, c, p), ca = orientation(c, a, p);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

/// Number of short edges of a kind, with the longest of them.
struct CountedEdges {
  int count = 0;
  double longest = 0;
  Point at;  ///< middle of the longest
  std::string boundary;

  void add(const Geometry& g, const ShortEdge& edge) {
    ++count;
    if (edge.length <= longest) return;
    longest = edge.length;
    at = middle_of(g, edge.first, edge.last);
    boundary = g.boundary(g.boundary_of(edge.first)).name;
  }
};

bool is_small(const Geometry& g, std::int32_t loop, double min) {
  Box box;
  for (std::int32_t v = g.loop_start(loop); v < g.loop_start(loop + 1); ++v) box.include(g.point(v));
  return box.width() < min && box.height() < min;
}

bool has_twins(const Geometry& g, std::int32_t loop) {
  std::int32_t s = g.loop_start(loop);
  while (s < g.loop_start(loop + 1) && g.twin(s) < 0) ++s;
  return s < g.loop_start(loop + 1);
}

/// Returns the parts of a loop between consecutive feature points less than four `min` apart, in order from
/// the first one after a gap. Empty without a gap.
std::vector<ShortEdge> near_points_of(const Geometry& g, std::int32_t loop, double min) {
  constexpr double near = 4;
  std::vector<ShortEdge> edges;
  for (std::int32_t v = g.loop_start(loop); v < g.loop_start(loop + 1); ++v) {
    if (!g.kept(v)) continue;
    if (const auto stretch = g.stretch_shorter_than(near * min, v))
      edges.push_back({v, stretch->end, stretch->length});
  }
  if (edges.empty()) return edges;
  std::int32_t before = edges.back().last;
  const auto after_gap = std::ranges::find_if(
      edges, [&](const ShortEdge& edge) { return std::exchange(before, edge.last) != edge.first; });
  if (after_gap == edges.end()) return {};
  std::ranges::rotate(edges, after_gap);
  return edges;
}

/// Returns the short edges between up to four feature points that are apart from others: a base, a step, a
/// tab or a notch. Longer rows of feature points, e.g. along a coast, lose points in the mesh anyway. An edge
/// with layers does not count, as it has columns, whose width is not limited.
std::vector<ShortEdge> short_edges_of(const Geometry& g, std::int32_t loop, double min) {
  constexpr std::ptrdiff_t most_edges = 3;
  const std::vector<ShortEdge> all = near_points_of(g, loop, min);
  std::vector<ShortEdge> edges;
  for (auto begin = all.begin(); begin != all.end();) {
    const auto is_apart = [](const ShortEdge& a, const ShortEdge& b) { return a.last != b.first; };
    const auto last = std::adjacent_find(begin, all.end(), is_apart);
    const auto end = last == all.end() ? last : last + 1;
    if (end - begin <= most_edges)
      std::copy_if(begin, end, std::back_inserter(edges), [&](const ShortEdge& edge) {
        return edge.length < min && !g.boundary(g.boundary_of(edge.first)).layers;
      });
    begin = end;
  }
  return edges;
}

/// The bases of a geometry whose ends can be merged, and the short edges that must stay.
class Bases {
 public:
  Bases(const Geometry& geometry, double min)
      : g_{geometry}, segments_{geometry}, segments_of_(geometry.boundaries().size(), 0) {
    for (std::int32_t s = 0; s < g_.size(); ++s) ++segments_of_[g_.boundary_of(s)];
    edges_.resize(g_.loop_count());
    for (std::int32_t loop = 0; loop < g_.loop_count(); ++loop) {
      // The mesh drops small loops; the twins of other loops would not move with a loop's vertices.
      if (is_small(g_, loop, min) || has_twins(g_, loop)) continue;
      edges_[loop] = short_edges_of(g_, loop, min);
      add_bases(edges_[loop], min);
    }
  }

  const CountedEdges& left() const { return left_; }

  /// Returns bases that can be merged at the same time, at least one if there are any: the parts of the
  /// geometry that they change lie apart.
  std::vector<Base> independent() {
    const BoxTree boxes(size32(bases_), [&](std::int32_t b) { return box_of(bases_[b]); });
    std::vector<char> is_taken(bases_.size(), 0);
    std::vector<Base> taken;
    for (std::int32_t b = 0; b < std::ssize(bases_); ++b) {
      const Base& base = bases_[b];
      if (is_needed(base) ||
          boxes.any_meeting(box_of(base), [&](std::int32_t other) { return is_taken[other] != 0; }))
        continue;
      segments_of_[g_.boundary_of(base.first)] -= segments_in(base);
      is_taken[b] = 1;
      taken.push_back(base);
    }
    return taken;
  }

 private:
  /// Splits consecutive edges into bases as long as possible; if such a base cannot be merged, its first edge
  /// alone may be.
  void add_bases(std::span<const ShortEdge> edges, double min) {
    while (!edges.empty()) {
      std::size_t count = 1;
      double sum = edges[0].length;
      for (; count < edges.size() && edges[count].first == edges[count - 1].last; ++count) {
        sum += edges[count].length;
        if (sum >= min || g_.boundary_of(edges[count].first) != g_.boundary_of(edges[0].first)) break;
      }
      if (!can_merge(base_of(edges.first(count)))) count = 1;
      const Base base = base_of(edges.first(count));
      if (can_merge(base)) {
        bases_.push_back(base);
      } else {
        left_.add(g_, edges[0]);
      }
      edges = edges.subspan(count);
    }
  }

  static Base base_of(std::span<const ShortEdge> edges) {
    return {{edges.front().first, edges.back().last}, edges};
  }

  bool can_merge(const Base& base) const { return !is_needed(base) && leaves_outline_simple(base); }

  /// Whether the boundary or the loop consists of little more than the base.
  bool is_needed(const Base& base) const {
    const std::int32_t loop = g_.loop_of(base.first), segments = segments_in(base);
    const BoundaryId boundary = g_.boundary_of(base.first);
    return segments_of_[boundary] <= segments ||
           g_.boundary(boundary).condition == BoundaryCondition::interface ||
           g_.loop_start(loop + 1) - g_.loop_start(loop) < 4 + segments;
  }

  std::int32_t segments_in(const Base& base) const {
    const std::int32_t loop = g_.loop_of(base.first), count = base.last - base.first;
    return count > 0 ? count : count + g_.loop_start(loop + 1) - g_.loop_start(loop);
  }

  bool is_in(const Base& base, std::int32_t segment) const {
    if (base.first < base.last) return segment >= base.first && segment < base.last;
    return (segment >= base.first || segment < base.last) && g_.loop_of(segment) == g_.loop_of(base.first);
  }

  /// The box of the base and of the two segments beside it: merging changes nothing outside.
  Box box_of(const Base& base) const {
    Box box;
    for (std::int32_t v = g_.previous(base.first); v != base.last; v = g_.next(v)) box.include(g_.point(v));
    box.include(g_.point(base.last));
    box.include(g_.point(g_.next(base.last)));
    return box;
  }

  /// Whether the two segments that would end in the middle of the base touch no other segment, and nothing
  /// lies between them and the old ones.
  bool leaves_outline_simple(const Base& base) const {
    const std::int32_t before = g_.previous(base.first), after = base.last;
    const Point to = merged_end(g_, base), from = g_.point(before), end = g_.point(g_.next(after));
    if (on_segment(end, from, to) || on_segment(from, to, end)) return false;
    return !segments_.any_meeting(box_of(base), [&](std::int32_t s) {
      if (s == before || s == after || is_in(base, s)) return false;
      return touches(s, from, to, g_.point(base.first)) || touches(s, end, to, g_.point(after)) ||
             is_between(s, base, to);
    });
  }

  /// Whether the segment meets the triangles between the base's own segments and `to`.
  bool is_between(std::int32_t segment, const Base& base, Point to) const {
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
    if (old == to) return false;
    const Point a = g_.point(segment), b = g_.point(g_.next(segment));
    if (a != fixed && in_closed_triangle(a, fixed, old, to)) return true;
    if (b != fixed && in_closed_triangle(b, fixed, old, to)) return true;
    if (a == fixed || b == fixed) return segments_meet(a, b, old, to);
    return segments_meet(a, b, fixed, to);
  }

  const Geometry& g_;
  SegmentTree segments_;
  IdVector<BoundaryId, std::int32_t> segments_of_;
  std::vector<std::vector<ShortEdge>> edges_;  ///< of each loop
  std::vector<Base> bases_;
  CountedEdges left_;
};

std::string text_of(const CountedEdges& edges, double min, const char* consequence) {
  return fmt::format(
      "{} edge{} between corners shorter than spacing.min = {:g}, the longest {:.3g} at ({:.6g}, {:.6g}) of "
      "boundary '{}': {}; make spacing.min smaller",
      edges.count, edges.count == 1 ? "" : "s", min, edges.longest, edges.at.x, edges.at.y, edges.boundary,
      consequence);
}

}  // namespace

Point merged_end(const Geometry& g, ShortBase base) {
  const bool first = begins_another_boundary(g, base.first), last = begins_another_boundary(g, base.last);
  if (first == last) return middle_of(g, base.first, base.last);
  return g.point(first ? base.first : base.last);
}

Geometry with_merged(const Geometry& g, std::span<const ShortBase> bases) {
  std::vector<char> is_dropped(g.size(), 0);
  std::vector<Point> moved{g.points().begin(), g.points().end()};
  for (const ShortBase base : bases) {
    for (std::int32_t v = base.first; v != base.last; v = g.next(v)) is_dropped[v] = 1;
    moved[base.last] = merged_end(g, base);
  }
  GeometryBuilder builder;
  for (std::int32_t loop = 0; loop < g.loop_count(); ++loop) {
    for (std::int32_t v = g.loop_start(loop); v < g.loop_start(loop + 1); ++v) {
      if (is_dropped[v] == 0) builder.add(moved[v], g.boundary_of(v), g.curve(v), g.returns(v));
    }
    builder.end_loop(g.block_of(g.loop_start(loop)));
  }
  return std::move(builder).geometry(g.boundaries(), g.block_names());
}

std::optional<Geometry> short_edges_merged(const Geometry& geometry, double min,
                                           std::vector<std::string>& warnings) {
  std::optional<Geometry> result;
  CountedEdges merged, left;
  for (bool is_done = false; !is_done;) {
    const Geometry& current = result ? *result : geometry;
    Bases bases(current, min);
    left = bases.left();
    const std::vector<Base> chosen = bases.independent();
    for (const Base& base : chosen) {
      for (const ShortEdge& edge : base.edges) merged.add(current, edge);
    }
    is_done = chosen.empty();
    if (!is_done) result = with_merged(current, std::vector<ShortBase>(chosen.begin(), chosen.end()));
  }
  if (left.count > 0) warnings.push_back(text_of(left, min, "triangles there may be thin"));
  if (result) warnings.push_back(text_of(merged, min, "the two ends became one node"));
  return result;
}

}  // namespace quadloop
