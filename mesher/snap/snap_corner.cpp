#include "mesher/snap/snap_corner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesher/geometry/nearest_on_segment.hpp"

namespace quadloop {

namespace {

constexpr double swallow_share = 0.15;  ///< of the local edge: no vertex vanishes that lies farther than this
                                        ///< from the outline as it goes on from the corner

/// Sights of crossings that the outline passes one after another near the corner: the same crossing, and the
/// two ends of one piece, belong to one run. Numbers of the corner's sights, ascending.
using Run = std::vector<std::size_t>;

bool contains(const Run& run, std::size_t sight) { return std::binary_search(run.begin(), run.end(), sight); }

bool on_one_piece(const Sight& a, const Sight& b) { return a.trace == b.trace && a.piece == b.piece; }

/// A sight's piece from its crossing on, as long as it turns near the corner only.
struct Stretch {
  std::vector<std::int32_t> turns;     ///< vertices
  std::vector<std::int32_t> segments;  ///< up to the first turn that is not near
  Point goes_on;                       ///< that turn, or the piece's other end
};

/// What vanishes in a corner that takes a run.
struct Swallowed {
  std::vector<std::int32_t> vertices;
  std::vector<Point> goes_on;  ///< where the outline goes on from the corner: nowhere for an island round it
};

/// The steps of one corner's decision; none changes anything.
class CornerDecision {
 public:
  CornerDecision(const Geometry& geometry, const LeafTraces& traces, const SightedCorner& corner,
                 double share)
      : geometry_{geometry}, traces_{traces}, corner_{corner}, sights_{corner.sights}, share_{share} {}

  /// A whole run is taken where that is a contraction, else what of it claims the corner.
  std::optional<Snap> decide() const {
    if (std::none_of(sights_.begin(), sights_.end(), [&](const Sight& s) { return claims(s); })) return {};
    for (const bool whole_run : {true, false}) {
      const std::vector<Run> runs = runs_among(whole_run);
      const Run* run = nearest_claimant(runs);
      if (run == nullptr || passes_over(*run)) continue;
      if (const auto target = target_of(*run)) return snap_to(*target, *run);
    }
    return std::nullopt;
  }

  std::optional<Snap> decide(const CornerCapture& capture) const {
    const Point target = geometry_.point(capture.vertex);
    for (const bool whole_run : {true, false}) {
      const std::vector<Run> runs = runs_among(whole_run);
      const Run* run = run_of(capture, runs);
      if (run != nullptr && !passes_over(*run) && follows(swallowed_by(*run), target))
        return snap_to(target, *run);
    }
    const bool claimed =
        std::any_of(sights_.begin(), sights_.end(), [&](const Sight& s) { return claims(s); });
    return claimed ? decide() : snap_to(target, {});
  }

 private:
  bool claims(const Sight& s) const { return s.distance < share_ * corner_.edge; }
  double distance(Point p) const { return length(p - corner_.position); }
  bool is_near(Point p) const { return distance(p) < corner_reach * corner_.edge; }

  /// A piece's vertices inside its leaf.
  std::span<const std::int32_t> vertices_of(const Sight& s) const {
    const LeafTrace view = traces_[s.trace];
    return view.vertices_of(view.pieces[s.piece]);
  }

  /// Whether two sights belong to one run. A kept point far from the corner parts what comes before from what
  /// comes after it.
  bool in_one_run(const Sight& a, const Sight& b) const {
    if (a.direction == b.direction && a.segment == b.segment) return true;
    if (!on_one_piece(a, b)) return false;
    const auto vertices = vertices_of(a);
    return std::none_of(vertices.begin(), vertices.end(),
                        [&](std::int32_t v) { return geometry_.kept(v) && !is_near(geometry_.point(v)); });
  }

  /// The runs among the crossings that claim the corner and, if asked, those that are at least nearer to it
  /// than to the far end of their edge: the corner there is farther, and never takes them.
  std::vector<Run> runs_among(bool whole_run) const {
    std::vector<Run> runs;
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      const bool nearer = 2 * sights_[i].distance < sights_[i].edge;
      if (!claims(sights_[i]) && !(whole_run && nearer)) continue;
      const auto joined = std::stable_partition(runs.begin(), runs.end(), [&](const Run& run) {
        return std::none_of(run.begin(), run.end(),
                            [&](std::size_t j) { return in_one_run(sights_[i], sights_[j]); });
      });
      Run run{i};
      for (auto part = joined; part != runs.end(); ++part) run.insert(run.end(), part->begin(), part->end());
      std::sort(run.begin(), run.end());
      runs.erase(joined, runs.end());
      runs.push_back(std::move(run));
    }
    return runs;
  }

  /// The run that claims the corner and comes nearest; none where two come equally near.
  const Run* nearest_claimant(const std::vector<Run>& runs) const {
    double best = corner_.edge;
    const Run* nearest = nullptr;
    for (const Run& run : runs) {
      if (std::none_of(run.begin(), run.end(), [&](std::size_t i) { return claims(sights_[i]); })) continue;
      const double run_distance = distance(nearest_point(run));
      if (run_distance == best) nearest = nullptr;
      if (run_distance < best) nearest = &run;
      best = std::min(best, run_distance);
    }
    return nearest;
  }

  /// The run of the point that captures the corner: of the first sight of its piece.
  const Run* run_of(const CornerCapture& capture, const std::vector<Run>& runs) const {
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      if (sights_[i].trace != capture.trace || sights_[i].piece != capture.piece) continue;
      const auto run = std::find_if(runs.begin(), runs.end(), [&](const Run& r) { return contains(r, i); });
      if (run != runs.end()) return &*run;
    }
    return nullptr;
  }

  /// Whether a crossing that is not taken lies between the corner and one that is: no contraction.
  bool passes_over(const Run& run) const {
    for (const std::size_t i : run) {
      for (std::size_t j = 0; j < sights_.size(); ++j) {
        if (sights_[j].direction == sights_[i].direction && sights_[j].distance <= sights_[i].distance &&
            !contains(run, j))
          return true;
      }
    }
    return false;
  }

  Stretch stretch_from(const Sight& s) const {
    const LeafTrace view = traces_[s.trace];
    const Piece& piece = view.pieces[s.piece];
    const auto vertices = view.vertices_of(piece);
    Stretch stretch{{}, {s.segment}, view.crossing(s.at_entry ? piece.exit : piece.entry).position};
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const std::int32_t v = s.at_entry ? vertices[i] : vertices[vertices.size() - 1 - i];
      if (!geometry_.straight(v) && !is_near(geometry_.point(v))) {
        stretch.goes_on = geometry_.point(v);
        break;
      }
      if (!geometry_.straight(v)) stretch.turns.push_back(v);
      stretch.segments.push_back(s.at_entry ? v : geometry_.previous(v));
    }
    return stretch;
  }

  /// Of a corner that moves along an axis the run's crossing there. Off the axis the outline may come as near
  /// on both sides, and neither place is its own image.
  std::optional<Point> crossing_on_axis(const Run& run) const {
    std::optional<Point> nearest;
    if (!corner_.mirror || side_of(*corner_.mirror, corner_.position) != 0) return nearest;
    for (const std::size_t i : run) {
      const Sight& s = sights_[i];
      const LeafTrace view = traces_[s.trace];
      const Piece& piece = view.pieces[s.piece];
      const Point p = view.crossing(s.at_entry ? piece.entry : piece.exit).position;
      if (side_of(*corner_.mirror, p) != 0) continue;
      if (!nearest || distance(p) < distance(*nearest)) nearest = p;
    }
    return nearest;
  }

  /// Of two places equally near, whether the first is taken instead of the second, which was found before:
  /// an order that a mirror image keeps, if there is to be one.
  bool goes_before(Point p, Point found) const {
    if (!corner_.mirror) return false;
    const auto rank = [&](Point q) {
      const double height = height_over(*corner_.mirror, q);
      return std::pair(std::abs(height), *corner_.mirror == MirrorAxis::x ? q.x : q.y);
    };
    return rank(p) < rank(found);
  }

  /// The nearest point to the corner on the outline from a run's crossings on, as long as it stays near.
  Point nearest_point(const Run& run) const {
    if (const auto on_axis = crossing_on_axis(run)) return *on_axis;
    Point nearest;
    double least = std::numeric_limits<double>::infinity();
    for (const std::size_t i : run) {
      for (const std::int32_t s : stretch_from(sights_[i]).segments) {
        const Point p =
            nearest_on_segment(corner_.position, geometry_.point(s), geometry_.point(geometry_.next(s)));
        if (distance(p) > least || (distance(p) == least && !goes_before(p, nearest))) continue;
        least = distance(p);
        nearest = p;
      }
    }
    return nearest;
  }

  /// A piece with both ends in the run vanishes whole.
  Swallowed swallowed_by(const Run& run) const {
    Swallowed swallowed;
    for (const std::size_t i : run) {
      const Sight& s = sights_[i];
      const bool vanishes = std::any_of(run.begin(), run.end(), [&](std::size_t j) {
        return on_one_piece(sights_[j], s) && sights_[j].at_entry != s.at_entry;
      });
      if (vanishes) {
        const auto vertices = vertices_of(s);
        std::copy_if(vertices.begin(), vertices.end(), std::back_inserter(swallowed.vertices),
                     [&](std::int32_t v) { return !geometry_.straight(v); });
      } else {
        const Stretch stretch = stretch_from(s);
        swallowed.goes_on.push_back(stretch.goes_on);
        swallowed.vertices.insert(swallowed.vertices.end(), stretch.turns.begin(), stretch.turns.end());
      }
    }
    return swallowed;
  }

  /// Where a corner that takes the run goes: to a kept point that vanishes in it, else to the nearest point
  /// of the outline, or to a vertex that strays from the outline beside it: the nearest that does. None where
  /// two kept points would vanish, or what lies too far off, or a whole loop.
  std::optional<Point> target_of(const Run& run) const {
    Swallowed swallowed = swallowed_by(run);
    std::vector<std::int32_t>& vertices = swallowed.vertices;
    Point target = nearest_point(run);
    for (const std::int32_t v : vertices) {
      if (geometry_.kept(v)) target = geometry_.point(v);
    }
    if (follows(swallowed, target)) return target;
    const auto distance_of = [&](std::int32_t v) { return distance(geometry_.point(v)); };
    std::sort(vertices.begin(), vertices.end(),
              [&](std::int32_t a, std::int32_t b) { return distance_of(a) < distance_of(b); });
    for (const std::int32_t v : vertices) {
      const bool tied = std::any_of(vertices.begin(), vertices.end(), [&](std::int32_t other) {
        return other != v && distance_of(other) == distance_of(v);
      });
      if (!tied && follows(swallowed, geometry_.point(v))) return geometry_.point(v);
    }
    return std::nullopt;
  }

  /// Whether the target is near the corner, and no vertex that vanishes in it strays from the outline as it
  /// goes on from there, nor is a kept one.
  bool follows(const Swallowed& swallowed, Point target) const {
    return is_near(target) && !swallowed.goes_on.empty() &&
           std::none_of(swallowed.vertices.begin(), swallowed.vertices.end(), [&](std::int32_t v) {
             const Point p = geometry_.point(v);
             double stray = std::numeric_limits<double>::infinity();
             for (const Point end : swallowed.goes_on)
               stray = std::min(stray, length(p - nearest_on_segment(p, target, end)));
             return stray > swallow_share * corner_.edge || (geometry_.kept(v) && p != target);
           });
  }

  Snap snap_to(Point target, const Run& run) const {
    Snap snap{corner_.corner, target, corner_.position, corner_reach * corner_.edge, {}};
    for (const std::size_t i : run) {
      const Snap::Absorbed crossing{sights_[i].segment, is_vertical(sights_[i].direction)};
      if (std::find(snap.absorbed.begin(), snap.absorbed.end(), crossing) == snap.absorbed.end())
        snap.absorbed.push_back(crossing);
    }
    return snap;
  }

  const Geometry& geometry_;
  const LeafTraces& traces_;
  const SightedCorner& corner_;
  std::span<const Sight> sights_;
  double share_;
};

}  // namespace

std::optional<Snap> snap_corner(const Geometry& geometry, const LeafTraces& traces,
                                const SightedCorner& corner, double share) {
  return CornerDecision(geometry, traces, corner, share).decide();
}

std::optional<Snap> snap_captured(const Geometry& geometry, const LeafTraces& traces,
                                  const SightedCorner& corner, double share, const CornerCapture& capture) {
  return CornerDecision(geometry, traces, corner, share).decide(capture);
}

}  // namespace quadloop
