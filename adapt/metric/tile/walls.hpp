#pragma once

#include <string>
#include <utility>
#include <vector>

#include "mesher/geometry/point.hpp"
#include "smoother/outline/outline_path.hpp"

namespace quadloop {

/// What nodes on the outline may do when a mesh is adapted: the rules of BoundarySlide, for nodes that come
/// and go as well.
class Walls {
 public:
  /// The mesh's boundaries by their names. Of segments with a height in `front_heights` (one for each segment
  /// of the outline, or none) edges and nodes stay: they carry layers. `outline` must outlive them.
  Walls(const OutlinePath& outline, std::vector<std::string> boundaries, std::vector<double> front_heights)
      : outline_{outline}, boundaries_{std::move(boundaries)}, heights_{std::move(front_heights)} {}

  /// From now on edges are divided alone: nodes stay where they are.
  void keep_nodes() { keeps_nodes_ = true; }

  OutlinePlace place_of(Point p, std::int32_t boundary) const {
    return outline_.locate(p, boundaries_[boundary]);
  }
  /// Whether a mesh must keep a node there.
  bool is_kept(Point p, std::int32_t boundary) const {
    const OutlinePlace place = place_of(p, boundary);
    return !place.valid() || place.kept;
  }

  using Chord = OutlinePath::Chord;
  /// Whether an edge of the boundary may be divided, or joined with the next one: both ends lie on the same
  /// loop of the outline, the way between them is that of the chord, and no layers stand on it.
  bool may_change(const Chord& chord) const;
  /// The place in the middle of the way that a chord stands for.
  OutlinePlace middle_of(const Chord& chord) const {
    return outline_.moved(chord.from, 0.5 * outline_.way(chord.from, chord.to));
  }
  OutlinePlace moved(OutlinePlace from, double step) const { return outline_.moved(from, step); }
  double way(OutlinePlace from, OutlinePlace to) const { return outline_.way(from, to); }
  Point point_at(OutlinePlace place) const { return outline_.point_at(place); }

  /// Whether the chords a-p and p-b may stand for the way from a to b, where a-b, or a-q and q-b, did.
  bool may_divide(const Chord& whole, OutlinePlace at, Point p) const;
  bool may_slide(const Chord& whole, OutlinePlace at, Point p, OutlinePlace before, Point q) const;
  /// Whether the chord a-b may, where a-p and p-b did.
  bool may_join(const Chord& whole, OutlinePlace at, Point p) const;

 private:
  double deviation(const Chord& chord) const {
    return outline_.deviation(chord.from, chord.a, chord.to, chord.b);
  }
  double deviation(const Chord& whole, OutlinePlace at, Point p) const;
  bool meets_nothing(const Chord& chord) const { return outline_.met_elsewhere(chord).empty(); }

  const OutlinePath& outline_;
  std::vector<std::string> boundaries_;
  std::vector<double> heights_;
  bool keeps_nodes_ = false;
};

}  // namespace quadloop
