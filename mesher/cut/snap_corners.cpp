#include "mesher/cut/snap_corners.hpp"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

#include "mesher/cut/capture_points.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"

namespace quadloop {

namespace {

constexpr double capture_share =
    0.45;  ///< of the local edge: a kept point nearer than this takes the corner; two corners cannot claim it
constexpr double swallow_share = 0.15;  ///< of the local edge: no vertex vanishes that lies farther than this
                                        ///< from the outline as it goes on from the corner

/// A crossing as one of the corners at the ends of its leaf edge sees it, through one of the two leaves at
/// that edge.
struct Sight {
  std::int64_t x = 0, y = 0;  ///< the corner
  int direction = 0;          ///< of the edge from the corner: 0 east, 1 north, 2 west, 3 south
  double distance = 0;        ///< along the edge
  double edge = 0;            ///< its length
  std::int32_t segment = -1;
  std::int32_t trace = -1, piece = -1;
  bool at_entry = false;  ///< of the piece
  bool vertical() const { return direction % 2 == 1; }
};

bool same_crossing(const Sight& a, const Sight& b) {
  return a.direction == b.direction && a.segment == b.segment;
}

/// Adds what the two ends of each crossing's leaf edge see of it.
class SightCollector {
 public:
  SightCollector(const LeafGraph& graph, const Lattice& lattice, std::vector<Sight>& sights)
      : graph_{graph}, lattice_{lattice}, sights_{sights} {}

  void add_leaf(std::int32_t leaf, std::int32_t trace, const LeafTrace& view) {
    for (std::size_t p = 0; p < view.pieces.size(); ++p) {
      const Piece& piece = view.pieces[p];
      if (piece.entry < 0) continue;
      add_crossing(leaf, trace, static_cast<std::int32_t>(p), view.crossing(piece.entry), true);
      add_crossing(leaf, trace, static_cast<std::int32_t>(p), view.crossing(piece.exit), false);
    }
  }

 private:
  void add_crossing(std::int32_t leaf, std::int32_t trace, std::int32_t piece, const Crossing& c,
                    bool at_entry) {
    const Quadrant& q = graph_.leaf(leaf);
    const bool horizontal = c.side % 2 == 0;
    const std::int64_t fixed = c.side == 0   ? q.y
                               : c.side == 1 ? q.x + q.size()
                               : c.side == 2 ? q.y + q.size()
                                             : q.x;
    std::int64_t from = horizontal ? q.x : q.y, to = from + q.size();
    const auto line = [&](std::int64_t i) { return horizontal ? lattice_.x(i) : lattice_.y(i); };
    const double at = horizontal ? c.position.x : c.position.y;
    if (graph_.has_hanging(leaf, static_cast<LeafGraph::Side>(c.side))) {
      const std::int64_t middle = from + q.size() / 2;
      (at < line(middle) ? to : from) = middle;
    }
    const double edge = line(to) - line(from);
    const auto see = [&](std::int64_t end, int direction) {
      sights_.push_back({horizontal ? end : fixed, horizontal ? fixed : end, direction,
                         std::abs(at - line(end)), edge, c.segment, trace, piece, at_entry});
    };
    see(from, horizontal ? 0 : 1);
    see(to, horizontal ? 2 : 3);
  }

  const LeafGraph& graph_;
  const Lattice& lattice_;
  std::vector<Sight>& sights_;
};

/// Decides one corner from all that it sees.
class CornerDecision {
 public:
  CornerDecision(const LeafGraph& graph, const Lattice& lattice, const Geometry& geometry,
                 const LeafTraces& traces, double share)
      : graph_{graph}, lattice_{lattice}, geometry_{geometry}, traces_{traces}, share_{share} {}

  std::optional<Snap> decide(std::span<Sight> sights) {
    double nearest = sights.front().distance;
    for (const Sight& s : sights) nearest = std::min(nearest, s.distance);
    if (nearest >= share_ * sights.front().edge * 2)
      return std::nullopt;  // edges at a corner differ by a factor of two at most
    corner_ = lattice_.corner(sights.front().x, sights.front().y);
    local_edge_ = shortest_edge_at(graph_, lattice_, sights.front().x, sights.front().y);
    if (nearest >= share_ * local_edge_) return std::nullopt;
    if (!absorb(sights, true) && !absorb(sights, false)) return std::nullopt;
    return snap_to(sights.front().x, sights.front().y, target_, sights);
  }

  /// A corner that a kept point captures: it takes that point's run along, as far as it can.
  std::optional<Snap> capture(const CornerCapture& captured, std::span<Sight> sights) {
    corner_ = lattice_.corner(captured.x, captured.y);
    local_edge_ = shortest_edge_at(graph_, lattice_, captured.x, captured.y);
    captured_ = &captured;
    const bool absorbs = absorb(sights, true) || absorb(sights, false);
    captured_ = nullptr;
    if (!absorbs) {
      const bool crossed = std::any_of(sights.begin(), sights.end(),
                                       [&](const Sight& s) { return s.distance < share_ * local_edge_; });
      if (crossed) return decide(sights);
      absorbed_.assign(sights.size(), 0);
    }
    return snap_to(captured.x, captured.y, geometry_.point(captured.vertex), sights);
  }

 private:
  Snap snap_to(std::int64_t x, std::int64_t y, Point target, std::span<const Sight> sights) const {
    Snap snap{x, y, target, corner_, capture_share * local_edge_, {}};
    for (std::size_t i = 0; i < sights.size(); ++i) {
      const Snap::Absorbed entry{sights[i].segment, sights[i].vertical()};
      const bool known = std::find(snap.absorbed.begin(), snap.absorbed.end(), entry) != snap.absorbed.end();
      if (absorbed_[i] != 0 && !known) snap.absorbed.push_back(entry);
    }
    return snap;
  }

  std::size_t root(std::size_t i) const {
    while (run_[i] != i) i = run_[i];
    return i;
  }

  /// Whether a kept point far from the corner lies on a sight's piece: what comes before and after it are two
  /// runs.
  bool parted(const Sight& s) const {
    const LeafTrace view = traces_[s.trace];
    const auto all = view.vertices_of(view.pieces[static_cast<std::size_t>(s.piece)]);
    return std::any_of(all.begin(), all.end(), [&](std::int32_t v) {
      return geometry_.kept(v) && length(geometry_.point(v) - corner_) >= capture_share * local_edge_;
    });
  }

  /// The runs among the crossings that may be taken: the same crossing, and the two ends of one piece, belong
  /// to one.
  void find_runs(std::span<const Sight> sights) {
    run_.resize(sights.size());
    std::iota(run_.begin(), run_.end(), std::size_t{0});
    for (std::size_t i = 0; i < sights.size(); ++i) {
      for (std::size_t j = 0; j < i && absorbed_[i] != 0; ++j) {
        const bool same_piece = sights[i].trace == sights[j].trace && sights[i].piece == sights[j].piece;
        if (absorbed_[j] == 0) continue;
        if (same_crossing(sights[i], sights[j]) || (same_piece && !parted(sights[i])))
          run_[root(i)] = root(j);
      }
    }
  }

  /// The vertices where a sight's piece turns, from its crossing on, as long as they stay near the corner.
  std::vector<std::int32_t> near_vertices(const Sight& s) const {
    const LeafTrace view = traces_[s.trace];
    const auto all = view.vertices_of(view.pieces[static_cast<std::size_t>(s.piece)]);
    std::vector<std::int32_t> near;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::int32_t v = s.at_entry ? all[i] : all[all.size() - 1 - i];
      if (geometry_.straight(v)) continue;
      if (length(geometry_.point(v) - corner_) >= capture_share * local_edge_) break;
      near.push_back(v);
    }
    return near;
  }

  /// The segments of a sight's piece from its crossing to the first turn that is not near the corner.
  std::vector<std::int32_t> near_segments(const Sight& s) const {
    const LeafTrace view = traces_[s.trace];
    const auto all = view.vertices_of(view.pieces[static_cast<std::size_t>(s.piece)]);
    std::vector<std::int32_t> segments{s.segment};
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::int32_t v = s.at_entry ? all[i] : all[all.size() - 1 - i];
      if (!geometry_.straight(v) && length(geometry_.point(v) - corner_) >= capture_share * local_edge_)
        break;
      segments.push_back(s.at_entry ? v : geometry_.previous(v));
    }
    return segments;
  }

  /// The point of a sight's piece, from its crossing on, that follows so many turns.
  Point point_after(const Sight& s, std::size_t turns) const {
    const LeafTrace view = traces_[s.trace];
    const Piece& piece = view.pieces[static_cast<std::size_t>(s.piece)];
    const auto all = view.vertices_of(piece);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::int32_t v = s.at_entry ? all[i] : all[all.size() - 1 - i];
      if (!geometry_.straight(v) && turns-- == 0) return geometry_.point(v);
    }
    return view.crossing(s.at_entry ? piece.exit : piece.entry).position;
  }

  /// The nearest point to the corner on the outline from the crossings of interest on, as long as it stays
  /// near.
  template <class OfInterest>
  Point nearest_point(std::span<const Sight> sights, const OfInterest& of_interest) const {
    Point point;
    double distance = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < sights.size(); ++i) {
      if (!of_interest(i)) continue;
      const auto try_segment = [&](std::int32_t s) {
        const Point p = nearest_on_segment(corner_, geometry_.point(s), geometry_.point(geometry_.next(s)));
        if (length(p - corner_) >= distance) return;
        distance = length(p - corner_);
        point = p;
      };
      for (const std::int32_t segment : near_segments(sights[i])) try_segment(segment);
    }
    return point;
  }

  /// The run that claims the corner and comes nearest; none where two come equally near.
  std::optional<std::size_t> nearest_run(std::span<const Sight> sights) const {
    std::vector<std::size_t> claimants;
    for (std::size_t i = 0; i < sights.size(); ++i) {
      if (sights[i].distance < share_ * local_edge_) claimants.push_back(root(i));
    }
    std::sort(claimants.begin(), claimants.end());
    claimants.erase(std::unique(claimants.begin(), claimants.end()), claimants.end());
    double best = local_edge_;
    std::optional<std::size_t> nearest;
    for (const std::size_t run : claimants) {
      const double distance =
          length(nearest_point(sights, [&](std::size_t i) { return root(i) == run; }) - corner_);
      if (distance == best) nearest.reset();
      if (distance < best) nearest = run;
      best = std::min(best, distance);
    }
    return nearest;
  }

  /// The run of the point that captures the corner.
  std::optional<std::size_t> captured_run(std::span<const Sight> sights) const {
    for (std::size_t i = 0; i < sights.size(); ++i) {
      if (absorbed_[i] != 0 && sights[i].trace == captured_->trace && sights[i].piece == captured_->piece)
        return root(i);
    }
    return std::nullopt;
  }

  /// Marks what the corner takes: one run of the crossings near it and, if asked, of those that are at least
  /// nearer to it than to the far end of their edge. False where that would not be a contraction, or swallow
  /// too much.
  bool absorb(std::span<const Sight> sights, bool whole_run) {
    absorbed_.assign(sights.size(), 0);
    for (std::size_t i = 0; i < sights.size(); ++i) {
      const bool claims = sights[i].distance < share_ * local_edge_;
      const bool free = 2 * sights[i].distance <
                        sights[i].edge;  // the corner at the far end is farther, and never takes it
      absorbed_[i] = claims || (whole_run && free);
    }
    find_runs(sights);
    const auto chosen = captured_ != nullptr ? captured_run(sights) : nearest_run(sights);
    if (!chosen) return false;
    for (std::size_t i = 0; i < sights.size(); ++i) absorbed_[i] = absorbed_[i] != 0 && root(i) == *chosen;
    for (std::size_t i = 0; i < sights.size(); ++i) {
      for (std::size_t j = 0; j < sights.size(); ++j) {
        const bool passed_over = absorbed_[i] != 0 && absorbed_[j] == 0 &&
                                 sights[j].direction == sights[i].direction &&
                                 sights[j].distance <= sights[i].distance;
        if (passed_over) return false;
      }
    }
    return find_target(sights);
  }

  /// Whether both ends of the sight's piece are absorbed.
  bool vanishes(std::span<const Sight> sights, const Sight& s) const {
    for (std::size_t j = 0; j < sights.size(); ++j) {
      if (absorbed_[j] != 0 && sights[j].trace == s.trace && sights[j].piece == s.piece &&
          sights[j].at_entry != s.at_entry)
        return true;
    }
    return false;
  }

  /// Sets the target: a kept point that vanishes in the corner, else the nearest point of the outline. False
  /// where two kept points would vanish, or what lies too far off, or a whole loop.
  bool find_target(std::span<const Sight> sights) {
    std::vector<std::int32_t> swallowed;
    std::vector<Point> stubs;  // where the outline goes on from the corner: nowhere for an island round it
    for (std::size_t i = 0; i < sights.size(); ++i) {
      if (absorbed_[i] == 0) continue;
      if (vanishes(sights, sights[i])) {
        const LeafTrace view = traces_[sights[i].trace];
        const auto all = view.vertices_of(view.pieces[static_cast<std::size_t>(sights[i].piece)]);
        std::copy_if(all.begin(), all.end(), std::back_inserter(swallowed),
                     [&](std::int32_t v) { return !geometry_.straight(v); });
      } else {
        const auto near = near_vertices(sights[i]);
        stubs.push_back(point_after(sights[i], near.size()));
        swallowed.insert(swallowed.end(), near.begin(), near.end());
      }
    }
    if (stubs.empty()) return false;
    target_ = nearest_point(sights, [&](std::size_t i) { return absorbed_[i] != 0; });
    for (const std::int32_t v : swallowed) {
      if (geometry_.kept(v)) target_ = geometry_.point(v);
    }
    if (captured_ != nullptr) target_ = geometry_.point(captured_->vertex);
    return follows(swallowed, stubs) || (captured_ == nullptr && move_to_vertex(swallowed, stubs));
  }

  /// Whether the target is near the corner, and no vertex that vanishes in it strays from the outline as it
  /// goes on from there, nor is a kept one.
  bool follows(std::span<const std::int32_t> swallowed, std::span<const Point> stubs) const {
    return length(target_ - corner_) < capture_share * local_edge_ &&
           std::none_of(swallowed.begin(), swallowed.end(), [&](std::int32_t v) {
             const Point p = geometry_.point(v);
             double stray = std::numeric_limits<double>::infinity();
             for (const Point stub : stubs)
               stray = std::min(stray, length(p - nearest_on_segment(p, target_, stub)));
             return stray > swallow_share * local_edge_ || (geometry_.kept(v) && p != target_);
           });
  }

  /// A vertex that strays from the outline beside it may be the target itself: the nearest that does.
  bool move_to_vertex(std::vector<std::int32_t> swallowed, std::span<const Point> stubs) {
    const auto distance = [&](std::int32_t v) { return length(geometry_.point(v) - corner_); };
    std::sort(swallowed.begin(), swallowed.end(),
              [&](std::int32_t a, std::int32_t b) { return distance(a) < distance(b); });
    for (std::size_t i = 0; i < swallowed.size(); ++i) {
      const bool tied = (i > 0 && distance(swallowed[i - 1]) == distance(swallowed[i]) &&
                         swallowed[i - 1] != swallowed[i]) ||
                        (i + 1 < swallowed.size() && distance(swallowed[i + 1]) == distance(swallowed[i]) &&
                         swallowed[i + 1] != swallowed[i]);
      if (tied) continue;
      target_ = geometry_.point(swallowed[i]);
      if (follows(swallowed, stubs)) return true;
    }
    return false;
  }

  const LeafGraph& graph_;
  const Lattice& lattice_;
  const Geometry& geometry_;
  const LeafTraces& traces_;
  double share_;
  Point corner_, target_;
  double local_edge_ = 0;
  const CornerCapture* captured_ = nullptr;  ///< while a captured corner is decided
  std::vector<std::size_t> run_;
  std::vector<char> absorbed_;
};

}  // namespace

namespace {

/// Sorts small keys and then moves each sight once.
void sort_by_corner(std::vector<Sight>& sights) {
  struct Key {
    std::int64_t x, y;
    std::uint32_t index;
  };
  std::vector<Key> keys;
  keys.reserve(sights.size());
  for (const Sight& s : sights) keys.push_back({s.x, s.y, static_cast<std::uint32_t>(keys.size())});
  std::sort(keys.begin(), keys.end(), [](const Key& a, const Key& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.index < b.index;
  });
  std::vector<Sight> sorted;
  sorted.reserve(sights.size());
  for (const Key& key : keys) sorted.push_back(sights[key.index]);
  sights = std::move(sorted);
}

/// Adds those whose place is not taken.
void add_hanging(const std::vector<Snap>& hanging, std::vector<Snap>& snaps) {
  std::set<std::pair<std::int64_t, std::int64_t>> taken;
  for (const Snap& s : snaps) taken.emplace(s.x, s.y);
  for (const Snap& s : hanging) {
    if (taken.emplace(s.x, s.y).second) snaps.push_back(s);
  }
}

/// Forgets the crossings that bent edges have taken.
void drop_taken(const std::vector<Snap>& edges, std::vector<Sight>& sights) {
  std::set<std::tuple<bool, std::int64_t, std::int32_t>> taken;  // vertical, line, segment
  for (const Snap& edge : edges) {
    for (const Snap::Absorbed& a : edge.absorbed)
      taken.emplace(edge.vertical, edge.vertical ? edge.x : edge.y, a.segment);
  }
  std::erase_if(sights, [&](const Sight& s) {
    return taken.contains({s.vertical(), s.vertical() ? s.x : s.y, s.segment});
  });
}

}  // namespace

std::vector<Snap> choose_snaps(const LeafGraph& graph, const Lattice& lattice, const Geometry& geometry,
                               const TracedForest& traced, double share) {
  std::vector<Sight> sights;
  SightCollector collector(graph, lattice, sights);
  for (std::int32_t leaf = 0; leaf < graph.size(); ++leaf) {
    const std::int32_t trace = traced.trace_of[static_cast<std::size_t>(leaf)];
    if (trace >= 0) collector.add_leaf(leaf, trace, traced.traces[trace]);
  }
  sort_by_corner(sights);
  Captures captures = capture_points(graph, lattice, geometry, traced, share);
  drop_taken(captures.edges, sights);
  std::vector<Snap> snaps = std::move(captures.edges);
  CornerDecision decision(graph, lattice, geometry, traced.traces, share);
  auto captured = captures.corners.begin();
  const auto before = [](const auto& a, const auto& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  for (std::size_t begin = 0, end = 0; begin < sights.size() || captured != captures.corners.end();
       begin = end) {
    const bool capture =
        captured != captures.corners.end() && (begin == sights.size() || !before(sights[begin], *captured));
    const std::int64_t x = capture ? captured->x : sights[begin].x,
                       y = capture ? captured->y : sights[begin].y;
    while (end < sights.size() && sights[end].x == x && sights[end].y == y) ++end;
    const auto at_corner = std::span(sights).subspan(begin, end - begin);
    auto snap = capture ? decision.capture(*captured++, at_corner) : decision.decide(at_corner);
    if (snap) snaps.push_back(std::move(*snap));
  }
  add_hanging(hanging_snaps(graph, lattice, geometry, traced, share), snaps);
  return snaps;
}

std::vector<LeafSnap> snaps_of_leaves(const LeafGraph& graph, const std::vector<Snap>& snaps) {
  std::vector<LeafSnap> result;
  for (const Snap& snap : snaps) {
    std::array<std::int32_t, 4> seen{LeafGraph::none, LeafGraph::none, LeafGraph::none, LeafGraph::none};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::int32_t leaf = graph.leaf_at(snap.x - 1 + static_cast<std::int64_t>(k & 1),
                                              snap.y - 1 + static_cast<std::int64_t>(k >> 1));
      if (!graph.is_local(leaf) || std::find(seen.begin(), seen.end(), leaf) != seen.end()) continue;
      seen[k] = leaf;
      if (snap.on_edge) {
        const int side = snap.vertical ? (k & 1) == 0 ? 1 : 3 : k < 2 ? 2 : 0;
        result.push_back({leaf, 8 + side, &snap});
        continue;
      }
      const Quadrant& q = graph.leaf(leaf);
      const std::int64_t half = q.size() / 2;
      constexpr std::array<std::array<int, 3>, 3> places{{{0, 4, 1}, {7, -1, 5}, {3, 6, 2}}};
      result.push_back({leaf,
                        places[static_cast<std::size_t>((snap.y - q.y) / half)]
                              [static_cast<std::size_t>((snap.x - q.x) / half)],
                        &snap});
    }
  }
  std::sort(result.begin(), result.end(), [](const LeafSnap& a, const LeafSnap& b) {
    return a.leaf != b.leaf ? a.leaf < b.leaf : a.place < b.place;
  });
  return result;
}

}  // namespace quadloop
