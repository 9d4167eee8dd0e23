#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/segment_tree.hpp"

namespace quadloop {

/// A place on the outline: the length walked along a loop from its first vertex, the loop, and the segment
/// that holds it. OutlinePath makes them.
struct OutlinePlace {
  double arc = 0;
  std::int32_t loop = -1;
  std::int32_t segment = -1;
  bool kept = false;  ///< it was found at a vertex that a mesh must keep
  bool valid() const { return loop >= 0; }
};

/// The outline as curves to slide along.
class OutlinePath {
 public:
  /// `geometry` must outlive it.
  explicit OutlinePath(const Geometry& geometry);

  using Segments = std::vector<std::int32_t>;
  /// The segments that may lie as near to a box as `on_outline` of the outline's extent: all that questions
  /// within it have to look at.
  Segments segments_near(Box box) const;
  /// The same in a list that is at hand.
  void find_segments_near(Box box, Segments& near) const;

  /// The place of a point that lies on the boundary of this name, to `on_outline` of the outline's extent; an
  /// invalid one where it does not. `near`: the segments near a box that holds the point.
  OutlinePlace locate(Point p, const std::string& boundary, std::span<const std::int32_t> near) const;
  OutlinePlace locate(Point p, const std::string& boundary) const {
    return locate(p, boundary, segments_near({p, p}));
  }
  static constexpr double on_outline = 1e-9;

  /// Whether the outline has a boundary of this name.
  bool has(const std::string& boundary) const;
  /// How far a point lies from the boundary of this name; infinitely where that is more than `within`.
  double distance(Point p, const std::string& boundary, double within) const;
  /// The length that `on_outline` stands for.
  double tolerance() const { return tolerance_; }

  /// The length of a loop, and of the way along it from its first vertex to another one.
  double loop_length(std::int32_t loop) const { return length_[loop]; }
  double arc_of(std::int32_t vertex) const { return arc_[vertex]; }

  /// The place at an arc, which may lie beyond the loop's ends by less than its length.
  OutlinePlace place_at(std::int32_t loop, double arc) const;
  /// The place so far ahead of another, or behind it; quick for short steps.
  OutlinePlace moved(const OutlinePlace& from, double step) const;
  Point point_at(const OutlinePlace& place) const { return line_of(place.segment).point_at(place.arc); }
  /// Asks the processor for what a place's segment holds.
  void fetch(const OutlinePlace& place) const {
    __builtin_prefetch(&arc_[place.segment]);
    __builtin_prefetch(&geometry_.points()[place.segment]);
  }
  /// point_at(moved(from, step)) of each step, quick for those that stay on the segment.
  void points_at(const OutlinePlace& from, std::span<const double> steps, std::span<Point> points) const;

  /// The way from one place to another of the same loop, walked with the domain to the left.
  double way(const OutlinePlace& from, const OutlinePlace& to) const {
    return within(from.loop, to.arc - from.arc);
  }

  /// How far the outline strays from the chord a-b between two places, at most; infinitely where more than a
  /// few vertices lie between.
  double deviation(const OutlinePlace& from, Point a, const OutlinePlace& to, Point b) const;

  /// A chord of the outline that a mesh's boundary edge is, with the way it stands for.
  struct Chord {
    OutlinePlace from, to;
    Point a, b;
  };
  static Box box_round(const Chord& chord, Point apex) {
    Box box = box_of(chord.a, chord.b);
    box.include(apex);
    return box;
  }
  /// The segments outside the chord's own part of the outline that it has a point in common with; `near`: the
  /// segments near a box that holds the chord.
  Segments met_elsewhere(const Chord& chord, std::span<const std::int32_t> near) const;
  Segments met_elsewhere(const Chord& chord) const {
    return met_elsewhere(chord, segments_near(box_of(chord.a, chord.b)));
  }
  /// Whether a vertex outside that part lies in the triangle that the chord makes with a point, or on its
  /// edges; `near`: the segments near a box that holds the triangle.
  bool sweeps_over(const Chord& chord, Point apex, std::span<const std::int32_t> near) const;
  bool sweeps_over(const Chord& chord, Point apex) const {
    return sweeps_over(chord, apex, segments_near(box_round(chord, apex)));
  }

  /// The segments from one place to another of the same loop, in order; none where there are more than a few.
  Segments segments_between(const OutlinePlace& from, const OutlinePlace& to) const;
  /// Calls `visit(segment)` for the same; returns false, after a few, where there are more.
  template <class Visit>
  bool walk(const OutlinePlace& from, const OutlinePlace& to, const Visit& visit) const;

 private:
  static constexpr std::size_t most_vertices = 1000;  ///< that one chord may stand for
  struct Nearest {
    std::int32_t segment = -1;
    double distance = 0;
  };
  Nearest nearest(Point p, const std::string& boundary, double within,
                  std::span<const std::int32_t> near) const;
  Box box_of_segment(std::int32_t s) const {
    return box_of(geometry_.point(s), geometry_.point(geometry_.next(s)));
  }
  std::int32_t segment_at(std::int32_t loop, double arc) const;
  /// A segment, and the arcs that it holds: from `begin` on, short of `end`.
  struct Line {
    Point a, b;
    double begin, end;
    bool holds(double arc) const { return begin <= arc && arc < end; }
    Point point_at(double arc) const {
      const double whole = length(b - a), along = arc - begin;
      return along >= whole ? b : a + (along / whole) * (b - a);
    }
  };
  Line line_of(std::int32_t segment) const {
    const std::int32_t next = geometry_.next(segment);
    const double end = next <= segment ? std::numeric_limits<double>::infinity() : arc_[next];
    return {geometry_.point(segment), geometry_.point(next), arc_[segment], end};
  }
  double within(std::int32_t loop, double arc) const {
    const double whole = loop_length(loop);
    if (arc < 0) arc += whole;
    return arc >= whole ? arc - whole : arc;
  }
  /// The part of the outline that a chord stands for.
  struct Part {
    std::int32_t before = -1, after = -1;  ///< segments that touch its ends, if any
    double way = 0;                        ///< its length
  };
  Part part_of(const Chord& chord) const;
  bool belongs(std::int32_t segment, const Chord& chord) const;
  bool is_of(std::int32_t segment, const std::string& boundary) const {
    return geometry_.boundary(geometry_.boundary_of(segment)).name == boundary;
  }

  const Geometry& geometry_;
  std::vector<double> arc_;     ///< of each vertex, from its loop's first
  std::vector<double> length_;  ///< of each loop
  double tolerance_ = 0;
  SegmentTree segments_;
};

template <class Visit>
bool OutlinePath::walk(const OutlinePlace& from, const OutlinePlace& to, const Visit& visit) const {
  // On the way over the loop's first vertex, perhaps back to the segment where it begins.
  const bool goes_round = to.arc < from.arc;
  std::int32_t s = from.segment;
  for (std::size_t walked = 0; walked < most_vertices; ++walked, s = geometry_.next(s)) {
    visit(s);
    if (s == to.segment && !(goes_round && walked == 0)) return true;
  }
  return false;
}

}  // namespace quadloop
