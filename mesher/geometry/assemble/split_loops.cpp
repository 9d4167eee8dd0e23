#include "mesher/geometry/assemble/split_loops.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/crossing_point.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

Box widened(Box box, double by) {
  box.low = box.low - Point{by, by};
  box.high = box.high + Point{by, by};
  return box;
}

/// Moves points onto near points of earlier loops.
void join_near_points(std::vector<SplitLoop>& loops, double near) {
  std::vector<Point*> points;
  std::vector<std::size_t> loop_of;
  for (std::size_t l = 0; l < loops.size(); ++l) {
    for (Point& p : loops[l].points) points.push_back(&p);
    loop_of.resize(points.size(), l);
  }
  const std::vector<Point> given = [&] {
    std::vector<Point> all;
    for (const Point* p : points) all.push_back(*p);
    return all;
  }();
  const BoxTree tree(size32(points), [&](std::int32_t i) { return Box{given[i], given[i]}; });
  for (std::int32_t i = 0; i < size32(points); ++i) {
    std::int32_t earliest = i;
    tree.for_each_meeting(widened({given[i], given[i]}, near), [&](std::int32_t j) {
      if (loop_of[j] != loop_of[i]) earliest = std::min(earliest, j);
    });
    *points[i] = *points[earliest];
  }
}

/// A piece and the points that split it.
struct SplitPiece {
  Point a, b;
  std::int32_t loop = 0;
  std::vector<Point> inner = {};

  /// Returns whether the point is new; ends do not count.
  bool add(Point p) {
    if (p == a || p == b || std::ranges::count(inner, p) > 0) return false;
    inner.push_back(p);
    return true;
  }
  bool has_end(Point p) const { return p == a || p == b; }
};

/// One round of splitting at all places where two pieces meet.
class SplitRound {
 public:
  explicit SplitRound(const std::vector<SplitLoop>& loops) {
    for (std::size_t l = 0; l < loops.size(); ++l) {
      const auto& points = loops[l].points;
      for (std::size_t i = 0; i < loops[l].segment.size(); ++i)
        pieces_.push_back({points[i], points[(i + 1) % points.size()], static_cast<std::int32_t>(l)});
    }
  }

  /// Returns whether any piece is split.
  bool find(double near) {
    const BoxTree tree(size32(pieces_), [&](std::int32_t i) { return box_of(pieces_[i].a, pieces_[i].b); });
    bool any = false;
    for (std::int32_t i = 0; i < size32(pieces_); ++i) {
      tree.for_each_meeting(widened(box_of(pieces_[i].a, pieces_[i].b), near), [&](std::int32_t j) {
        if (j > i && meet(pieces_[i], pieces_[j], near)) {
          any = true;
          place_ = pieces_[i].a;
        }
      });
    }
    return any;
  }

  Point place() const { return place_; }  ///< near one of the splits

  void apply_to(std::vector<SplitLoop>& loops) {
    std::size_t piece = 0;
    for (SplitLoop& loop : loops) {
      SplitLoop split{{}, {}, loop.open};
      for (const std::int32_t segment : loop.segment) {
        SplitPiece& here = pieces_[piece++];
        if (here.a == here.b) continue;
        std::ranges::sort(here.inner, {}, [&](Point p) {
          return std::pair(place_on_segment(p, here.a, here.b).parameter, p);
        });
        split.points.push_back(here.a);
        split.points.insert(split.points.end(), here.inner.begin(), here.inner.end());
        split.segment.resize(split.points.size(), segment);
      }
      if (loop.open) split.points.push_back(loop.points.back());
      loop = std::move(split);
    }
  }

 private:
  static bool lies_on(Point p, const SplitPiece& piece, double near) {
    if (piece.has_end(p)) return false;
    if (on_segment(p, piece.a, piece.b)) return true;
    const PlaceOnSegment place = place_on_segment(p, piece.a, piece.b);
    return place.parameter > 0 && place.parameter < 1 && place.squared_distance <= near * near;
  }

  static bool meet(SplitPiece& s, SplitPiece& t, double near) {
    if (s.loop == t.loop) near = 0;
    bool touch = false, split = false;
    for (auto [ends, across] : {std::pair(&s, &t), std::pair(&t, &s)}) {
      for (const Point end : {ends->a, ends->b}) {
        if (!lies_on(end, *across, near)) continue;
        touch = true;
        split = across->add(end) || split;
      }
    }
    if (touch || s.has_end(t.a) || s.has_end(t.b)) return split;
    if (!segments_meet(s.a, s.b, t.a, t.b)) return false;
    const Point at = crossing_point(s.a, s.b, t.a, t.b);
    const bool of_s = s.add(at), of_t = t.add(at);
    return of_s || of_t;
  }

  std::vector<SplitPiece> pieces_;
  Point place_;
};

std::vector<SplitLoop> split(std::vector<SplitLoop> loops, double near) {
  constexpr int most_rounds = 50;  // each round bends pieces by rounding only; two or three are usual
  join_near_points(loops, near);
  Point place;
  for (int round = 0; round < most_rounds; ++round) {
    SplitRound splits(loops);
    const bool any = splits.find(round == 0 ? near : 0);
    place = splits.place();
    splits.apply_to(loops);
    if (!any) return loops;
  }
  throw InputError(
      fmt::format("the boundaries near ({}, {}) overlap in too many places closer than rounding; make "
                  "geometry.join larger, or simplify the outline there",
                  place.x, place.y));
}

SplitLoop unsplit(const std::vector<Point>& points, bool open) {
  SplitLoop loop{points, std::vector<std::int32_t>(points.size() - (open ? 1 : 0)), open};
  std::iota(loop.segment.begin(), loop.segment.end(), 0);
  return loop;
}

}  // namespace

std::vector<SplitLoop> split_loops(const Outline& outline, double near) {
  std::vector<SplitLoop> loops;
  for (const OutlineLoop& loop : outline.loops) loops.push_back(unsplit(loop.points, false));
  return split(std::move(loops), near);
}

std::vector<SplitLoop> split_lines(std::span<const Chain> chains, double near) {
  std::vector<SplitLoop> lines;
  for (const Chain& chain : chains) lines.push_back(unsplit(chain.points, chain.open));
  return split(std::move(lines), near);
}

}  // namespace quadloop
