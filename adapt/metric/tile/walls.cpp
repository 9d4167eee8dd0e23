#include "adapt/metric/tile/walls.hpp"

#include <algorithm>

namespace quadloop::adapt {

namespace {

/// Allowed deviation of the geometry from chords, as a fraction of the shorter chord; the same as in cutting.
constexpr double stray_share = 0.15;
/// A chord is not changed if the part of the geometry that it represents is more than this many times as
/// long.
constexpr double longest_way = 20;

}  // namespace

bool Walls::may_change(const Chord& chord) const {
  if (!chord.from.valid() || !chord.to.valid() || chord.from.loop != chord.to.loop) return false;
  if (outline_.way(chord.from, chord.to) > longest_way * length(chord.b - chord.a)) return false;
  return heights_.empty() || !(heights_[middle_of(chord).segment] > 0);
}

double Walls::deviation(const Chord& whole, smoother::OutlinePlace at, Point p) const {
  return std::max(deviation({whole.from, at, whole.a, p}), deviation({at, whole.to, p, whole.b}));
}

bool Walls::may_divide(const Chord& whole, smoother::OutlinePlace at, Point p) const {
  return meets_nothing({whole.from, at, whole.a, p}) && meets_nothing({at, whole.to, p, whole.b}) &&
         !outline_.sweeps_over(whole, p);
}

bool Walls::may_slide(const Chord& whole, smoother::OutlinePlace at, Point p, smoother::OutlinePlace before,
                      Point q) const {
  if (keeps_nodes_) return false;
  const double shorter = std::min(length(p - whole.a), length(whole.b - p));
  const double allowed = std::max(deviation(whole, before, q), stray_share * shorter);
  return deviation(whole, at, p) <= allowed && may_divide(whole, at, p) && !outline_.sweeps_over(whole, q);
}

bool Walls::may_join(const Chord& whole, smoother::OutlinePlace at, Point p) const {
  if (keeps_nodes_) return false;
  const double allowed = std::max(deviation(whole, at, p), stray_share * length(whole.b - whole.a));
  return deviation(whole) <= allowed && meets_nothing(whole) && !outline_.sweeps_over(whole, p);
}

}  // namespace quadloop::adapt
