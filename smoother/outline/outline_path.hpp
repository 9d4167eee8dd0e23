#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/segment_tree.hpp"

namespace quadloop::smoother {

/// A place on the geometry: loop, arc length from the loop's first vertex, and segment. OutlinePath creates
/// them.
struct OutlinePlace {
  double arc = 0;
  std::int32_t loop = -1;
  std::int32_t segment = -1;
  bool kept = false;  ///< located at a vertex that a mesh must keep
  bool valid() const { return loop >= 0; }
};

/// The geometry as curves along which nodes slide. Arc lengths are those of chords.
class OutlinePath {
 public:
  /// `geometry` must outlive it.
  explicit OutlinePath(const Geometry& geometry);

  using Segments = std::vector<std::int32_t>;
  /// The segments that may be within `on_outline` of a box; sufficient for all queries inside the box.
  Segments segments_near(Box box) const;
  /// Same, into an existing list.
  void find_segments_near(Box box, Segments& near) const;

  /// The place of a point on the boundary of this name, within `on_outline`; invalid if the point is not on
  /// it. `near`: the segments near a box that contains the point.
  OutlinePlace locate(Point p, const std::string& boundary, std::span<const std::int32_t> near) const;
  OutlinePlace locate(Point p, const std::string& boundary) const {
    return locate(p, boundary, segments_near({p, p}));
  }
  static constexpr double on_outline = 1e-9;

  /// Whether the geometry has a boundary of this name.
  bool has(const std::string& boundary) const;
  /// The distance of a point from the boundary of this name; infinite if above `within`.
  double distance(Point p, const std::string& boundary, double within) const;
  /// `on_outline` as a length: `on_outline` times the extent of the geometry.
  double tolerance() const { return tolerance_; }

  /// The length of a loop; the arc length of a vertex from the loop's first one.
  double loop_length(std::int32_t loop) const { return length_[loop]; }
  double arc_of(std::int32_t vertex) const { return arc_[vertex]; }

  /// The place at an arc length, which may be outside the loop's range by less than the loop length.
  OutlinePlace place_at(std::int32_t loop, double arc) const;
  /// The place at the distance `step` from another one (negative: backwards); fast for short steps.
  OutlinePlace moved(const OutlinePlace& from, double step) const;
  Point point_at(const OutlinePlace& place) const {
    return geometry_.on_curve(place.segment, line_of(place.segment).point_at(place.arc));
  }
  /// Prefetches the segment of a place.
  void fetch(const OutlinePlace& place) const {
    __builtin_prefetch(&arc_[place.segment]);
    __builtin_prefetch(&geometry_.points()[place.segment]);
  }
  /// point_at(moved(from, step)) for each step; fast for steps within the segment.
  void points_at(const OutlinePlace& from, std::span<const double> steps, std::span<Point> points) const;

  /// The arc length from one place to another of the same loop, with the domain to the left.
  double way(const OutlinePlace& from, const OutlinePlace& to) const {
    return within(from.loop, to.arc - from.arc);
  }

  /// The largest deviation of the geometry from the chord a-b between two places; infinite if more than
  /// `most_vertices` vertices lie between.
  double deviation(const OutlinePlace& from, Point a, const OutlinePlace& to, Point b) const;

  /// A chord of the geometry (a boundary edge of the mesh) and the part of the geometry that it represents.
  struct Chord {
    OutlinePlace from, to;
    Point a, b;
  };
  static Box box_round(const Chord& chord, Point apex) {
    Box box = box_of(chord.a, chord.b);
    box.include(apex);
    return box;
  }
  /// The segments outside the chord's own part of the geometry that touch or cross it; `near`: the segments
  /// near a box that contains the chord.
  Segments met_elsewhere(const Chord& chord, std::span<const std::int32_t> near) const;
  Segments met_elsewhere(const Chord& chord) const {
    return met_elsewhere(chord, segments_near(box_of(chord.a, chord.b)));
  }
  /// Whether the triangle of the chord and a point contains a vertex outside that part, edges included;
  /// `near`: the segments near a box that contains the triangle.
  bool sweeps_over(const Chord& chord, Point apex, std::span<const std::int32_t> near) const;
  bool sweeps_over(const Chord& chord, Point apex) const {
    return sweeps_over(chord, apex, segments_near(box_round(chord, apex)));
  }

  /// The segments from one place to another of the same loop, in order; empty if there are more than
  /// `most_vertices`.
  Segments segments_between(const OutlinePlace& from, const OutlinePlace& to) const;
  /// Calls `visit(segment)` for the same segments; returns false, after `most_vertices`, if there are more.
  template <class Visit>
  bool walk(const OutlinePlace& from, const OutlinePlace& to, const Visit& visit) const;

 private:
  static constexpr std::size_t most_vertices = 1000;  ///< of a part that one chord may represent
  struct Nearest {
    std::int32_t segment = -1;
    double distance = 0;
  };
  Nearest nearest(Point p, const std::string& boundary, double within,
                  std::span<const std::int32_t> near) const;
  Box box_of_segment(std::int32_t s) const {
    return box_of(geometry_.point(s), geometry_.point(geometry_.next(s)));
  }
  static Box widened(const Box& box, double by) {
    return {box.low - Point{by, by}, box.high + Point{by, by}};
  }
  std::int32_t segment_at(std::int32_t loop, double arc) const;
  /// A segment and its range of arc lengths: `begin` included, `end` excluded.
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
  /// The distance of a point from a segment; from a curve the distance along the normal of its chord.
  double distance_to(std::int32_t segment, Point p) const;
  double within(std::int32_t loop, double arc) const {
    const double whole = loop_length(loop);
    if (arc < 0) arc += whole;
    return arc >= whole ? arc - whole : arc;
  }
  /// The part of the geometry that a chord represents.
  struct Part {
    std::int32_t before = -1, after = -1;  ///< segments that touch its ends, if any
    double way = 0;                        ///< its arc length
  };
  Part part_of(const Chord& chord) const;
  bool belongs(std::int32_t segment, const Chord& chord) const;
  bool branches_off(std::int32_t segment, const Chord& chord) const;
  /// Whether it is the way back along an inner line, which has the places of its twin.
  bool returns(std::int32_t segment) const {
    return geometry_.returns(segment) &&
           geometry_.boundary_of(segment) == geometry_.boundary_of(geometry_.twin(segment));
  }
  bool is_of(std::int32_t segment, const std::string& boundary) const {
    return geometry_.boundary(geometry_.boundary_of(segment)).name == boundary;
  }

  const Geometry& geometry_;
  std::vector<double> arc_;     ///< of each vertex, from its loop's first
  std::vector<double> length_;  ///< of each loop
  double tolerance_ = 0;
  double height_ = 0;  ///< largest distance of a curve from its chord
  SegmentTree segments_;
};

template <class Visit>
bool OutlinePath::walk(const OutlinePlace& from, const OutlinePlace& to, const Visit& visit) const {
  // True if the part passes the loop's first vertex, possibly returning to its first segment.
  const bool goes_round = to.arc < from.arc;
  std::int32_t s = from.segment;
  for (std::size_t walked = 0; walked < most_vertices; ++walked, s = geometry_.next(s)) {
    visit(s);
    if (s == to.segment && !(goes_round && walked == 0)) return true;
  }
  return false;
}

}  // namespace quadloop::smoother
