#include "mesher/snap/snap_corner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory_resource>
#include <utility>

#include "mesher/base/short_lists.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"

namespace quadloop {

namespace {

constexpr double swallow_share = 0.15;  ///< of the local edge: a vertex farther than this from the boundary
                                        ///< beyond the grid vertex does not vanish

constexpr std::int32_t none = -1;

/// Groups sights into runs: crossings that the boundary passes consecutively near the grid vertex. Sights of
/// one crossing, and the two ends of one piece, belong to one run.
class Runs {
 public:
  Runs(std::size_t sights, std::pmr::memory_resource* memory)
      : number_(sights, none, memory), sights_(memory) {}

  /// Construction: add sights in ascending order, each as a run of its own, join runs, then close.
  void add(std::int32_t sight) {
    number_[sight] = sight;
    sights_.push_back(sight);
  }
  void join(std::int32_t a, std::int32_t b) {
    const auto [low, high] = std::minmax({first_of(a), first_of(b)});  // by value
    number_[high] = low;
  }
  void close() {
    for (const std::int32_t sight : sights_) number_[sight] = number_[number_[sight]];
    std::ranges::sort(sights_, {}, [&](std::int32_t sight) { return std::pair(number_[sight], sight); });
  }

  /// The number of a sight's run (that of the run's first sight), or `none`.
  std::int32_t number_of(std::size_t sight) const { return number_[sight]; }
  /// The sights in runs, run after run, ascending in each.
  std::span<const std::int32_t> sights() const { return sights_; }

 private:
  std::int32_t first_of(std::int32_t sight) {
    while (number_[sight] != sight) sight = number_[sight] = number_[number_[sight]];
    return sight;
  }

  std::pmr::vector<std::int32_t> number_;  ///< until closed: an earlier sight of the run, or its own number
  std::pmr::vector<std::int32_t> sights_;
};

/// One run.
struct Run {
  const Runs* runs;
  std::int32_t number;
  std::span<const std::int32_t> sights;  ///< ascending

  bool contains(std::size_t sight) const { return runs->number_of(sight) == number; }
};

/// The run with a number.
Run run_at(const Runs& runs, std::int32_t number) {
  const auto found = std::ranges::equal_range(runs.sights(), number, {},
                                              [&](std::int32_t sight) { return runs.number_of(sight); });
  return {&runs, number, {found.begin(), found.end()}};
}

bool on_one_piece(const Sight& a, const Sight& b) { return a.trace == b.trace && a.piece == b.piece; }

/// A run that claims the grid vertex, and its nearest point.
struct Claim {
  Run run;
  Point nearest;
};

/// What vanishes when a grid vertex absorbs a run.
struct Swallowed {
  explicit Swallowed(std::pmr::memory_resource* memory) : vertices(memory), goes_on(memory) {}
  std::pmr::vector<std::int32_t> vertices;  ///< each once
  /// Points where the boundary continues from the grid vertex; empty for an island around it.
  std::pmr::vector<Point> goes_on;
};

/// The steps of the decision for one grid vertex; none has side effects.
class CornerDecision {
 public:
  /// `memory`: for the lists of the decision, which are short.
  CornerDecision(const Geometry& geometry, const LeafTraces& traces, const SightedCorner& corner,
                 double share, std::pmr::memory_resource* memory)
      : geometry_{geometry},
        traces_{traces},
        corner_{corner},
        sights_{corner.sights},
        share_{share},
        memory_{memory} {}

  /// Absorbs a whole run if that is a contraction, else the part of it that claims the vertex.
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
      const Runs runs = runs_among(whole_run, target);
      const std::optional<Run> run = run_of(capture, runs);
      if (!run || passes_over(*run)) continue;
      Swallowed swallowed = swallowed_by(*run);
      if (follows(swallowed, target)) return snap_to(target, run);
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

  /// Whether the ends of a piece belong to one run. A kept point far from the grid vertex separates them, as
  /// does one on a side of the leaf, where the piece ends: in a mirror image it may be inside.
  bool joins_its_ends(const Sight& s) const {
    const auto separates = [&](std::int32_t v) { return geometry_.kept(v) && !is_near(geometry_.point(v)); };
    const auto ends_there = [&](std::int32_t crossing) {
      const Crossing& at = traces_[s.trace].crossing(crossing);
      const std::array<std::int32_t, 2> ends{at.segment, geometry_.next(at.segment)};
      return std::ranges::any_of(
          ends, [&](std::int32_t v) { return geometry_.point(v) == at.position && separates(v); });
    };
    const Piece& piece = traces_[s.trace].pieces[s.piece];
    return std::ranges::none_of(vertices_of(s), separates) && !ends_there(piece.entry) &&
           !ends_there(piece.exit);
  }

  /// Equal for sights of one crossing.
  std::pair<Direction, std::int32_t> crossing_of(std::int32_t sight) const {
    return {sights_[sight].direction, sights_[sight].segment};
  }

  /// The runs among the crossings that claim the grid vertex. With `whole_run` also crossings nearer to it
  /// than to the far end of their edge: the vertex there is farther and never absorbs them. All pieces
  /// through a point where boundaries of blocks meet, `junction`, form one run.
  Runs runs_among(bool whole_run, std::optional<Point> junction = {}) const {
    Runs runs(sights_.size(), memory_);
    for (std::int32_t i = 0; i < size32(sights_); ++i) {
      const bool nearer = 2 * sights_[i].distance < sights_[i].edge;
      if (claims(sights_[i]) || (whole_run && nearer)) runs.add(i);
    }
    std::pmr::vector<std::int32_t> order(runs.sights().begin(), runs.sights().end(), memory_);
    for (std::size_t k = 1; k < order.size(); ++k) {  // both ends of a piece come one after the other
      const Sight& s = sights_[order[k]];
      if (on_one_piece(sights_[order[k - 1]], s) && joins_its_ends(s)) runs.join(order[k - 1], order[k]);
    }
    if (junction && geometry_.has_twins()) join_at(*junction, runs, order);
    std::sort(order.begin(), order.end(),
              [&](std::int32_t a, std::int32_t b) { return crossing_of(a) < crossing_of(b); });
    for (std::size_t k = 1; k < order.size(); ++k) {
      if (crossing_of(order[k - 1]) == crossing_of(order[k])) runs.join(order[k - 1], order[k]);
    }
    runs.close();
    return runs;
  }

  /// Joins the runs of all pieces through a point.
  void join_at(Point junction, Runs& runs, std::span<const std::int32_t> order) const {
    std::int32_t first = none;
    for (const std::int32_t i : order) {
      const auto is_there = [&](std::int32_t v) { return geometry_.point(v) == junction; };
      if (std::ranges::none_of(vertices_of(sights_[i]), is_there)) continue;
      if (first == none) first = i;
      runs.join(first, i);
    }
  }

  /// The nearest run that claims the grid vertex; none if two are equally near.
  std::optional<Claim> nearest_claim(const Runs& runs) const {
    double best = corner_.edge;
    std::optional<Claim> nearest;
    for (auto rest = runs.sights(); !rest.empty();) {
      const Run run = run_at(runs, runs.number_of(rest.front()));
      rest = rest.subspan(run.sights.size());
      if (std::ranges::none_of(run.sights, [&](std::int32_t i) { return claims(sights_[i]); })) continue;
      const Point point = nearest_point(run);
      const double run_distance = distance(point);
      if (run_distance == best) nearest.reset();
      if (run_distance < best) nearest = {run, point};
      best = std::min(best, run_distance);
    }
    return nearest;
  }

  /// The run of the capturing point: that of the first sight of its piece in a run.
  std::optional<Run> run_of(const CornerCapture& capture, const Runs& runs) const {
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      if (sights_[i].trace == capture.trace && sights_[i].piece == capture.piece && runs.number_of(i) != none)
        return run_at(runs, runs.number_of(i));
    }
    return std::nullopt;
  }

  /// Whether a crossing that is not absorbed lies between the vertex and one that is; then it is no
  /// contraction.
  bool passes_over(const Run& run) const {
    std::array<double, 4> nearest_other;  // of each direction
    nearest_other.fill(std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < sights_.size(); ++i) {
      double& nearest = nearest_other[index_of(sights_[i].direction)];
      if (!run.contains(i)) nearest = std::min(nearest, sights_[i].distance);
    }
    return std::ranges::any_of(run.sights, [&](std::int32_t i) {
      return nearest_other[index_of(sights_[i].direction)] <= sights_[i].distance;
    });
  }

  /// Follows a sight's piece from its crossing as long as its vertices are near the grid vertex: calls
  /// `segment` up to the first vertex that is not near, and `turn` for the vertices before it. Returns that
  /// vertex, or the piece's other end.
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

  Point crossing_at(std::int32_t sight) const {
    const Sight& s = sights_[sight];
    const LeafTrace view = traces_[s.trace];
    const Piece& piece = view.pieces[s.piece];
    return view.crossing(s.at_entry ? piece.entry : piece.exit).position;
  }

  /// The run's nearest crossing to which no other one is equally near, if any. Where the boundary is its own
  /// mirror image, that is a crossing on the axis.
  std::optional<Point> single_crossing(const Run& run) const {
    std::optional<Point> nearest;
    for (const std::int32_t i : run.sights) {
      const Point p = crossing_at(i);
      const bool single = std::ranges::none_of(run.sights, [&](std::int32_t k) {
        return sights_[k].distance == sights_[i].distance && crossing_at(k) != p;
      });
      if (single && (!nearest || distance(p) < distance(*nearest))) nearest = p;
    }
    return nearest;
  }

  /// For a vertex that moves along an axis: the run's crossing there. Off the axis the boundary may be
  /// equally near on both sides, and neither place is its own image.
  std::optional<Point> crossing_on_axis(const Run& run) const {
    std::optional<Point> nearest;
    if (!corner_.mirror || side_of(*corner_.mirror, corner_.position) != 0) return nearest;
    for (const std::int32_t i : run.sights) {
      const Point p = crossing_at(i);
      if (side_of(*corner_.mirror, p) == 0 && (!nearest || distance(p) < distance(*nearest))) nearest = p;
    }
    return nearest;
  }

  /// For two equally near places: whether the first replaces the second, found earlier. With a mirror axis
  /// the order is symmetric.
  bool goes_before(Point p, Point found) const {
    if (!corner_.mirror) return false;
    const auto rank = [&](Point q) {
      const double height = height_over(*corner_.mirror, q);
      return std::pair(std::abs(height), *corner_.mirror == MirrorAxis::x ? q.x : q.y);
    };
    return rank(p) < rank(found);
  }

  /// The point nearest to the grid vertex on the near part of the boundary at the run's crossings.
  Point nearest_point(const Run& run) const {
    if (const auto on_axis = crossing_on_axis(run)) return *on_axis;
    Point nearest;
    double least = std::numeric_limits<double>::infinity();
    bool contested = false;  // two places are equally near
    const auto see = [&](std::int32_t s) {
      const Point p =
          nearest_on_segment(corner_.position, geometry_.point(s), geometry_.point(geometry_.next(s)));
      const double to_p = distance(p);
      contested = to_p == least ? contested || p != nearest : contested && to_p > least;
      if (to_p > least || (to_p == least && !goes_before(p, nearest))) return;
      least = to_p;
      nearest = p;
    };
    for (const std::int32_t i : run.sights)
      follow(
          sights_[i], [](std::int32_t) {}, see);
    if (contested && !corner_.mirror) return single_crossing(run).value_or(nearest);
    return nearest;
  }

  /// Whether the run also contains the other end of a sight's piece: the sight before or after.
  bool has_other_end(const Run& run, std::int32_t sight) const {
    const Sight& s = sights_[sight];
    const auto is_other_end = [&](std::int32_t i) {
      return i >= 0 && i < size32(sights_) && run.contains(i) && on_one_piece(sights_[i], s) &&
             sights_[i].at_entry != s.at_entry;
    };
    return is_other_end(sight - 1) || is_other_end(sight + 1);
  }

  /// A piece with both ends in the run vanishes entirely.
  Swallowed swallowed_by(const Run& run) const {
    Swallowed swallowed(memory_);
    const auto swallow = [&](std::int32_t v) { swallowed.vertices.push_back(v); };
    for (const std::int32_t i : run.sights) {
      const Sight& s = sights_[i];
      if (!has_other_end(run, i)) {
        swallowed.goes_on.push_back(follow(s, swallow, [](std::int32_t) {}));
      } else if (s.at_entry) {
        for (const std::int32_t v : vertices_of(s)) {
          if (!geometry_.straight(v)) swallow(v);
        }
      }
    }
    return swallowed;
  }

  /// The target of a grid vertex that absorbs the run: a kept point that vanishes in it, else the nearest
  /// point of the boundary, or the nearest vertex that deviates too far from the boundary beside it. None if
  /// two kept points, something too far away, or a whole loop would vanish.
  std::optional<Point> target_of(const Claim& claim) const {
    Swallowed swallowed = swallowed_by(claim.run);
    const auto kept =
        std::ranges::find_if(swallowed.vertices, [&](std::int32_t v) { return geometry_.kept(v); });
    const bool holds_kept = kept != swallowed.vertices.end();
    const Point target = holds_kept ? geometry_.point(*kept) : claim.nearest;
    if (follows(swallowed, target)) return target;
    if (holds_kept) return std::nullopt;
    auto vertices = swallowed.vertices;
    const auto distance_of = [&](std::int32_t v) { return distance(geometry_.point(v)); };
    std::ranges::sort(vertices, {}, distance_of);
    for (std::size_t i = 0, end = 0; i < vertices.size(); i = end) {
      while (end < vertices.size() && distance_of(vertices[end]) == distance_of(vertices[i])) ++end;
      const Point p = geometry_.point(vertices[i]);
      if (end == i + 1 && follows(swallowed, p)) return p;
    }
    return std::nullopt;
  }

  /// Whether the target is near the grid vertex, and no vanishing vertex is kept or deviates too far from the
  /// boundary as it continues from the target. A vertex that does is tested first from then on, as it
  /// probably also fails for the next target.
  bool follows(Swallowed& swallowed, Point target) const {
    const auto& ways = swallowed.goes_on;
    if (!is_near(target) || ways.empty()) return false;
    std::size_t near = 0;  // direction near the last vertex; probably also near the next one
    const auto strays = [&](std::int32_t v) {
      const Point p = geometry_.point(v);
      if (geometry_.kept(v) && p != target) return true;
      const auto is_near_way = [&](Point end) {
        return length(p - nearest_on_segment(p, target, end)) <= swallow_share * corner_.edge;
      };
      for (std::size_t tried = 0; tried < ways.size(); ++tried, near = (near + 1) % ways.size()) {
        if (is_near_way(ways[near])) return false;
      }
      return true;
    };
    const auto straying = std::ranges::find_if(swallowed.vertices, strays);
    if (straying == swallowed.vertices.end()) return true;
    std::iter_swap(swallowed.vertices.begin(), straying);
    return false;
  }

  /// `run`: none for a vertex that absorbs no crossing.
  Snap snap_to(Point target, const std::optional<Run>& run) const {
    Snap snap{corner_.corner, target, corner_.position, corner_reach * corner_.edge, {}};
    if (!run) return snap;
    snap.absorbed.reserve(run->sights.size());
    for (const std::int32_t i : run->sights)
      snap.absorbed.push_back({sights_[i].segment, is_vertical(sights_[i].direction)});
    settle_absorbed(geometry_, snap);
    return snap;
  }

  const Geometry& geometry_;
  const LeafTraces& traces_;
  const SightedCorner& corner_;
  std::span<const Sight> sights_;
  double share_;
  std::pmr::memory_resource* memory_;
};

}  // namespace

std::optional<Snap> snap_corner(const Geometry& geometry, const LeafTraces& traces,
                                const SightedCorner& corner, double share) {
  ShortLists<1024> lists;
  return CornerDecision(geometry, traces, corner, share, lists.memory()).decide();
}

std::optional<Snap> snap_captured(const Geometry& geometry, const LeafTraces& traces,
                                  const SightedCorner& corner, double share, const CornerCapture& capture) {
  ShortLists<1024> lists;
  return CornerDecision(geometry, traces, corner, share, lists.memory()).decide(capture);
}

}  // namespace quadloop
