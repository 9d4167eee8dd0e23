#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mesher/geometry/point.hpp"
#include "smoother/outline/outline_path.hpp"

namespace quadloop::adapt {

/// Rules for nodes on the geometry when a mesh is adapted: those of BoundarySlide, extended to added and
/// removed nodes.
class Walls {
 public:
  /// `boundaries`: names of the mesh's boundaries. Edges and nodes on segments with a height in
  /// `front_heights` (one per segment of the geometry, or empty) do not change, as layers are attached there.
  /// `outline` must outlive it.
  Walls(const smoother::OutlinePath& outline, std::vector<std::string> boundaries,
        std::vector<double> front_heights)
      : outline_{outline}, boundaries_{std::move(boundaries)}, heights_{std::move(front_heights)} {}

  /// From now on nodes are kept and edges are only divided.
  void keep_nodes() { keeps_nodes_ = true; }

  smoother::OutlinePlace place_of(Point p, std::int32_t boundary) const {
    return outline_.locate(p, boundaries_[boundary]);
  }
  /// Whether a mesh must keep a node there.
  bool is_kept(Point p, std::int32_t boundary) const {
    const smoother::OutlinePlace place = place_of(p, boundary);
    return !place.valid() || place.kept;
  }

  using Chord = smoother::OutlinePath::Chord;
  /// Whether a boundary edge may be divided or joined with the next one: both its ends are on the same loop
  /// of the geometry, the part between them is that of the chord, and no layers are attached to it.
  bool may_change(const Chord& chord) const;
  /// The midpoint of the part of the geometry that a chord represents.
  smoother::OutlinePlace middle_of(const Chord& chord) const {
    return outline_.moved(chord.from, 0.5 * outline_.way(chord.from, chord.to));
  }
  smoother::OutlinePlace moved(smoother::OutlinePlace from, double step) const {
    return outline_.moved(from, step);
  }
  double way(smoother::OutlinePlace from, smoother::OutlinePlace to) const { return outline_.way(from, to); }
  Point point_at(smoother::OutlinePlace place) const { return outline_.point_at(place); }

  /// Whether the chords a-p and p-b may represent the part from a to b instead of a-b (may_divide), or
  /// instead of a-q and q-b (may_slide).
  bool may_divide(const Chord& whole, smoother::OutlinePlace at, Point p) const;
  bool may_slide(const Chord& whole, smoother::OutlinePlace at, Point p, smoother::OutlinePlace before,
                 Point q) const;
  /// Whether the chord a-b may replace a-p and p-b.
  bool may_join(const Chord& whole, smoother::OutlinePlace at, Point p) const;

 private:
  double deviation(const Chord& chord) const {
    return outline_.deviation(chord.from, chord.a, chord.to, chord.b);
  }
  double deviation(const Chord& whole, smoother::OutlinePlace at, Point p) const;
  bool meets_nothing(const Chord& chord) const { return outline_.met_elsewhere(chord).empty(); }

  const smoother::OutlinePath& outline_;
  std::vector<std::string> boundaries_;
  std::vector<double> heights_;
  bool keeps_nodes_ = false;
};

}  // namespace quadloop::adapt
