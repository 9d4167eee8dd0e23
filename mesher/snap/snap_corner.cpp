#include "mesher/snap/snap_corner.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory_resource>
#include <utility>

#include "mesher/geometry/nearest_on_segment.hpp"

namespace quadloop {

namespace {

constexpr double swallow_share = 0.15;  ///< of the local edge: no vertex vanishes that lies farther than this
                                        ///< from the outline as it goes on from the corner

/// Sights of crossings that the outline passes one after another near the corner: the same crossing, and the
/// two ends of one piece, belong to one run. Of each sight the number of its run, or `none`.
using Runs = std::pmr::vector<std::int32_t>;
constexpr std::int32_t none = -1;

/// One of them.
struct Run {
  const Runs* runs;
  std::int32_t number;

  bool contains(std::size_t sight) const { return (*runs)[sight] == number; }
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t i = 0; i < runs->size(); ++i) {
      if (contains(i)) visit(i);
    }
  }
  template <class Holds>
  bool any_of(const Holds& holds) const {
    for (std::size_t i = 0; i < runs->size(); ++i) {
      if (contains(i) && holds(i)) return true;
    }
    return false;
  }
};

bool on_one_piece(const Sight& a, const Sight& b) { return a.trace == b.trace && a.piece == b.piece; }

/// A run that claims the corner, and its nearest point.
struct Claim {
  Run run;
  Point nearest;
};

/// What vanishes in a corner that takes a run.
struct Swallowed {
  explicit Swallowed(std::pmr::memory_resource* memory) : vertices(memory), goes_on(memory) {}
  std::pmr::vector<std::int32_t> vertices;
  /// Where the outline goes on from the corner: nowhere for an island round it.
  std::pmr::vector<Point> goes_on;
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
      const Runs runs = runs_among(whole_run);
      const std::optional<Claim> claim = nearest_claim(runs);
      if (!claim || passes_over(claim->run)) continue;
      if (const auto target = target_of(*claim)) return snap_to(*target, claim->run);
    }
    return std::nullopt;
  }

  std::optional<Snap> decide(const CornerCapture& capture) const {
    const Point target = geometry_.point(capture.vertex);
    for (const bool whole_run : {true, false}) {
      const Runs runs = runs_among(whole_run);
      const Run run = run_of(capture, runs);
      if (run.number != none && !passes_over(run) && follows(swallowed_by(run), target))
        return snap_to(target, run);
    }
    const bool claimed =
        std::any_of(sights_.begin(), sights_.end(), [&](const Sight& s) { return claims(s); });
    return claimed ? decide() : snap_to(target, std::nullopt);
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
  Runs runs_among(bool whole_run) const {
    Runs runs(sights_.size(), none, &memory_);
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      const bool nearer = 2 * sights_[i].distance < sights_[i].edge;
      if (!claims(sights_[i]) && !(whole_run && nearer)) continue;
      runs[i] = static_cast<std::int32_t>(i);
      for (std::size_t j = 0; j < i; ++j) {
        if (runs[j] == none || runs[j] == runs[i] || !in_one_run(sights_[i], sights_[j])) continue;
        const std::int32_t own = runs[i], joined = runs[j];
        std::replace(runs.begin(), runs.end(), own, joined);
      }
    }
    return runs;
  }

  /// The run that claims the corner and comes nearest; none where two come equally near.
  std::optional<Claim> nearest_claim(const Runs& runs) const {
    double best = corner_.edge;
    std::optional<Claim> nearest;
    for (std::int32_t number = 0; number < size32(runs); ++number) {
      const Run run{&runs, number};
      if (!run.any_of([&](std::size_t i) { return claims(sights_[i]); })) continue;
      const Point point = nearest_point(run);
      const double run_distance = distance(point);
      if (run_distance == best) nearest.reset();
      if (run_distance < best) nearest = {run, point};
      best = std::min(best, run_distance);
    }
    return nearest;
  }

  /// The run of the point that captures the corner: of the first sight of its piece that has one.
  Run run_of(const CornerCapture& capture, const Runs& runs) const {
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      if (sights_[i].trace == capture.trace && sights_[i].piece == capture.piece && runs[i] != none)
        return {&runs, runs[i]};
    }
    return {&runs, none};
  }

  /// Whether a crossing that is not taken lies between the corner and one that is: no contraction.
  bool passes_over(const Run& run) const {
    return run.any_of([&](std::size_t i) {
      for (std::size_t j = 0; j < sights_.size(); ++j) {
        if (sights_[j].direction == sights_[i].direction && sights_[j].distance <= sights_[i].distance &&
            !run.contains(j))
          return true;
      }
      return false;
    });
  }

  /// Follows a sight's piece from its crossing on, as long as it turns near the corner only: calls `segment`
  /// up to the first turn that is not near, `turn` for the vertices before. Returns that turn, or the piece's
  /// other end.
  template <class Turn, class Segment>
  Point follow(const Sight& s, const Turn& turn, const Segment& segment) const {
    const LeafTrace view = traces_[s.trace];
    const Piece& piece = view.pieces[s.piece];
    const auto vertices = view.vertices_of(piece);
    segment(s.segment);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const std::int32_t v = s.at_entry ? vertices[i] : vertices[vertices.size() - 1 - i];
      if (!geometry_.straight(v)) {
        if (!is_near(geometry_.point(v))) return geometry_.point(v);
        turn(v);
      }
      segment(s.at_entry ? v : geometry_.previous(v));
    }
    return view.crossing(s.at_entry ? piece.exit : piece.entry).position;
  }

  /// Of a corner that moves along an axis the run's crossing there. Off the axis the outline may come as near
  /// on both sides, and neither place is its own image.
  std::optional<Point> crossing_on_axis(const Run& run) const {
    std::optional<Point> nearest;
    if (!corner_.mirror || side_of(*corner_.mirror, corner_.position) != 0) return nearest;
    run.for_each([&](std::size_t i) {
      const Sight& s = sights_[i];
      const LeafTrace view = traces_[s.trace];
      const Piece& piece = view.pieces[s.piece];
      const Point p = view.crossing(s.at_entry ? piece.entry : piece.exit).position;
      if (side_of(*corner_.mirror, p) == 0 && (!nearest || distance(p) < distance(*nearest))) nearest = p;
    });
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
    const auto see = [&](std::int32_t s) {
      const Point p =
          nearest_on_segment(corner_.position, geometry_.point(s), geometry_.point(geometry_.next(s)));
      const double to_p = distance(p);
      if (to_p > least || (to_p == least && !goes_before(p, nearest))) return;
      least = to_p;
      nearest = p;
    };
    run.for_each([&](std::size_t i) {
      follow(
          sights_[i], [](std::int32_t) {}, see);
    });
    return nearest;
  }

  /// A piece with both ends in the run vanishes whole.
  Swallowed swallowed_by(const Run& run) const {
    Swallowed swallowed(&memory_);
    const auto swallow = [&](std::int32_t v) { swallowed.vertices.push_back(v); };
    run.for_each([&](std::size_t i) {
      const Sight& s = sights_[i];
      const bool vanishes = run.any_of(
          [&](std::size_t j) { return on_one_piece(sights_[j], s) && sights_[j].at_entry != s.at_entry; });
      if (!vanishes) {
        swallowed.goes_on.push_back(follow(s, swallow, [](std::int32_t) {}));
        return;
      }
      for (const std::int32_t v : vertices_of(s)) {
        if (!geometry_.straight(v)) swallow(v);
      }
    });
    return swallowed;
  }

  /// Where a corner that takes the run goes: to a kept point that vanishes in it, else to the nearest point
  /// of the outline, or to a vertex that strays from the outline beside it: the nearest that does. None where
  /// two kept points would vanish, or what lies too far off, or a whole loop.
  std::optional<Point> target_of(const Claim& claim) const {
    Swallowed swallowed = swallowed_by(claim.run);
    auto& vertices = swallowed.vertices;
    Point target = claim.nearest;
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

  /// `run`: none for a corner that takes no crossing.
  Snap snap_to(Point target, const std::optional<Run>& run) const {
    Snap snap{corner_.corner, target, corner_.position, corner_reach * corner_.edge, {}};
    const auto absorb = [&](std::size_t i) {
      const Snap::Absorbed crossing{sights_[i].segment, is_vertical(sights_[i].direction)};
      if (std::find(snap.absorbed.begin(), snap.absorbed.end(), crossing) == snap.absorbed.end())
        snap.absorbed.push_back(crossing);
    };
    if (run) run->for_each(absorb);
    return snap;
  }

  const Geometry& geometry_;
  const LeafTraces& traces_;
  const SightedCorner& corner_;
  std::span<const Sight> sights_;
  double share_;
  /// For the lists of a decision, which are short.
  mutable std::array<std::byte, 1024> room_;
  mutable std::pmr::monotonic_buffer_resource memory_{room_.data(), room_.size()};
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
