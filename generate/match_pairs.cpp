#include "generate/match_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "generate/leaf_quadrant.hpp"
#include "generate/pair_sides.hpp"
#include "generate/split_edges.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/log.hpp"
#include "mesher/geometry/predicates.hpp"
#include "smoother/outline/nodes_on_curves.hpp"

namespace quadloop {

namespace {

using Positions = std::map<GlobalNodeId, Point>;

// Sizes ---------------------------------------------------------------------------------------------------

/// The quadtree cells at all edges of a boundary, in the order of BoundaryLine::edges.
std::vector<Quadrant> cells_at_edges(const Communicator& comm, const std::string& boundary,
                                     const MeshResult& result) {
  std::vector<Quadrant> own;
  for (std::size_t b = 0; b < result.mesh.boundaries.size(); ++b) {
    if (result.mesh.boundaries[b].name != boundary) continue;
    for (const std::int32_t leaf : result.edge_leaves[b])
      own.push_back(quadrant_of(result.tree.leaves[leaf]));
  }
  return comm.all_gather_values(std::span<const Quadrant>(own));
}

/// An edge on a side of a pair: its range of arc lengths, and its quadtree cell.
struct SizedEdge {
  double begin = 0, end = 0;
  Quadrant cell;
};

std::vector<SizedEdge> sized_edges(const BoundaryLine& line, const std::vector<double>& arcs,
                                   const std::vector<Quadrant>& cells) {
  std::vector<SizedEdge> edges;
  for (std::size_t e = 0; e < line.edges.size(); ++e)
    edges.push_back({arcs[e], arcs[e + 1], cells[line.edges[e]]});
  return edges;
}

/// Appends the splits of cells of which more than half is opposite smaller ones. If any overlap were enough,
/// cells that are shifted against each other would spread the smallest size along the whole boundary.
void append_splits(const std::vector<SizedEdge>& edges, const std::vector<SizedEdge>& opposite,
                   std::vector<SplitDemand>& demands) {
  auto first = opposite.begin();
  for (const SizedEdge& edge : edges) {
    while (first != opposite.end() && first->end <= edge.begin) ++first;
    double finer = 0;
    for (auto other = first; other != opposite.end() && other->begin < edge.end; ++other) {
      if (other->cell.level > edge.cell.level)
        finer += std::min(edge.end, other->end) - std::max(edge.begin, other->begin);
    }
    if (finer > 0.5 * (edge.end - edge.begin)) demands.push_back({edge.cell, 1U << edge.cell.level});
  }
}

// Nodes ---------------------------------------------------------------------------------------------------

/// A place where both sides of a pair have a node in the end.
struct Place {
  std::int32_t from = -1, to = -1;  ///< the node that is there, or moves there; -1: is added
  double arc = 0;
  /// Of two nodes: at the mean of their arc lengths, at that of one of them, or not the same place at all.
  enum class Choice { mean, from, to, apart } choice = Choice::mean;

  bool joins() const { return from >= 0 && to >= 0; }
};

/// For each node the shorter of the edges beside it.
std::vector<double> shorter_edges(const std::vector<double>& arcs) {
  std::vector<double> shorter;
  for (std::size_t i = 0; i < arcs.size(); ++i)
    shorter.push_back(std::min(i > 0 ? arcs[i] - arcs[i - 1] : arcs[1] - arcs[0],
                               i + 1 < arcs.size() ? arcs[i + 1] - arcs[i] : arcs[i] - arcs[i - 1]));
  return shorter;
}

/// For each arc length the nearest of the others, except the first and the last.
std::vector<std::int32_t> nearest_inner(const std::vector<double>& arcs, const std::vector<double>& others) {
  std::vector<std::int32_t> nearest;
  std::int32_t k = 1;
  for (const double arc : arcs) {
    while (k + 2 < size32(others) && std::abs(others[k + 1] - arc) < std::abs(others[k] - arc)) ++k;
    nearest.push_back(k + 1 < size32(others) ? k : -1);
  }
  return nearest;
}

class PairMatch {
 public:
  PairMatch(PairSides sides, const PairOutline& outline, const PeriodicPair& pair)
      : sides_{std::move(sides)}, outline_{outline}, pair_{pair} {
    find_partners();
  }

  /// The new positions of all nodes that have one.
  void append_positions(Positions& positions) const {
    for (const Place& place : places_) {
      if (place.joins() && is_end(place)) continue;
      const Point p = on_from(place);
      if (place.from >= 0) positions[sides_.from.nodes[place.from]] = p;
      if (place.to >= 0) positions[sides_.to.nodes[place.to]] = pair_.image(p);
    }
  }

  /// Takes the next choice for pairs of nodes of which one may not move as it should. Returns whether there
  /// was one.
  bool reconsider(const std::set<GlobalNodeId>& vetoed) {
    bool changed = false;
    std::vector<Place> kept;
    for (Place place : places_) {
      const bool is_vetoed =
          place.joins() && !is_end(place) &&
          (vetoed.contains(sides_.from.nodes[place.from]) || vetoed.contains(sides_.to.nodes[place.to]));
      if (is_vetoed && sides_.from_arcs[place.from] != sides_.to_arcs[place.to]) {
        changed = true;
        place.choice = static_cast<Place::Choice>(static_cast<int>(place.choice) + 1);
        if (place.choice == Place::Choice::apart) {
          kept.push_back({place.from, -1, sides_.from_arcs[place.from]});
          kept.push_back({-1, place.to, sides_.to_arcs[place.to]});
          continue;
        }
        place.arc = arc_of(place);
      }
      kept.push_back(place);
    }
    places_ = std::move(kept);
    sort_places();
    return changed;
  }

  /// The edges that get nodes, given the final positions.
  void append_splits(std::vector<EdgeSplit>& splits) const {
    append_splits_of(&Place::from, sides_.from.nodes, false, splits);
    append_splits_of(&Place::to, sides_.to.nodes, true, splits);
  }

  std::size_t joined() const { return std::ranges::count_if(places_, &Place::joins); }
  std::size_t places() const { return places_.size(); }

 private:
  bool is_end(const Place& place) const {
    return place.from == 0 || place.from + 1 == size32(sides_.from.nodes);
  }
  bool is_kept_from(std::int32_t i) const { return outline_.kept_at(sides_.from_arcs[i]); }
  bool is_kept_to(std::int32_t i) const { return outline_.kept_at(sides_.to_arcs[i]); }

  double arc_of(const Place& place) const {
    const double from = sides_.from_arcs[place.from], to = sides_.to_arcs[place.to];
    if (place.choice == Place::Choice::from || is_kept_from(place.from)) return from;
    if (place.choice == Place::Choice::to || is_kept_to(place.to)) return to;
    return std::abs(from - to) <= rounding * outline_.length() ? from : 0.5 * (from + to);
  }

  /// Where the node of `from` is: its own position, bit by bit, if it does not move.
  Point on_from(const Place& place) const {
    if (place.from >= 0 && place.arc == sides_.from_arcs[place.from]) return sides_.from.points[place.from];
    return outline_.on_from(place.arc);
  }

  void find_partners() {
    const std::vector<double>&from = sides_.from_arcs, &to = sides_.to_arcs;
    const std::vector<std::int32_t> of_from = nearest_inner(from, to), of_to = nearest_inner(to, from);
    const std::vector<double> from_edges = shorter_edges(from), to_edges = shorter_edges(to);
    std::vector<char> has_partner(to.size(), 0);
    places_.push_back({0, 0, 0});
    for (std::int32_t i = 1; i + 1 < size32(from); ++i) {
      const std::int32_t k = of_from[i];
      const bool is_near = k >= 0 && of_to[k] == i &&
                           std::abs(from[i] - to[k]) <= nearness * std::min(from_edges[i], to_edges[k]);
      const bool both_kept = is_near && is_kept_from(i) && is_kept_to(k) && from[i] != to[k];
      Place place{i, is_near && !both_kept ? k : -1, from[i]};
      if (place.joins()) has_partner[k] = 1, place.arc = arc_of(place);
      places_.push_back(place);
    }
    for (std::int32_t k = 1; k + 1 < size32(to); ++k) {
      if (has_partner[k] == 0) places_.push_back({-1, k, to[k]});
    }
    places_.push_back({size32(from) - 1, size32(to) - 1, outline_.length()});
    sort_places();
  }

  void sort_places() { std::ranges::stable_sort(places_, {}, &Place::arc); }

  void append_splits_of(std::int32_t Place::*node, const std::vector<GlobalNodeId>& nodes, bool is_to,
                        std::vector<EdgeSplit>& splits) const {
    std::vector<Point> added;
    std::int32_t last = 0;
    for (const Place& place : places_) {
      if (place.*node < 0) {
        added.push_back(is_to ? pair_.image(on_from(place)) : on_from(place));
        continue;
      }
      if (!added.empty()) {
        GlobalNodeId a = nodes[last], b = nodes[place.*node];
        if (is_to) {
          std::swap(a, b);
          std::ranges::reverse(added);
        }
        splits.push_back({a, b, std::exchange(added, {})});
      }
      last = place.*node;
    }
  }

  static constexpr double nearness = 0.5, rounding = 1e-14;

  PairSides sides_;
  const PairOutline& outline_;
  const PeriodicPair& pair_;
  std::vector<Place> places_;  ///< along `from`
};

Point position_in(const Positions& positions, const Mesh& mesh, NodeId node) {
  const auto at = positions.find(mesh.global(node));
  return at == positions.end() ? mesh.point(node) : at->second;
}

/// The sine of the smallest corner of a cell; 0 or less if it is not strictly convex and counter-clockwise.
template <std::size_t width>
double smallest_corner(const std::array<Point, width>& p) {
  double smallest = 1;
  for (std::size_t k = 0; k < width; ++k) {
    const Point a = p[(k + width - 1) % width], b = p[k], c = p[(k + 1) % width];
    if (orientation(a, b, c) <= 0) return 0;
    smallest = std::min(smallest, cross(b - a, c - b) / (length(b - a) * length(c - b)));
  }
  return smallest;
}

/// Returns the nodes of cells that would turn over or become thin if the nodes moved. *Collective.*
std::set<GlobalNodeId> vetoed_nodes(const Communicator& comm, const Mesh& mesh, const Positions& positions) {
  constexpr double thin = 0.1, worse = 0.5;
  std::vector<GlobalNodeId> own;
  NodeFlags moves(mesh.points.size(), 0);
  for (const NodeId node : moves.ids()) moves[node] = positions.contains(mesh.global(node)) ? 1 : 0;
  mesh.for_each_cell([&](const auto& nodes) {
    if (!any_flagged(moves, nodes)) return;
    auto moved = corners_of(mesh, nodes);
    const double before = smallest_corner(moved);
    for (std::size_t k = 0; k < nodes.size(); ++k) moved[k] = position_in(positions, mesh, nodes[k]);
    if (smallest_corner(moved) >= std::min(thin, worse * before) && smallest_corner(moved) > 0) return;
    for (const NodeId node : nodes)
      if (moves[node] != 0) own.push_back(mesh.global(node));
  });
  const std::vector<GlobalNodeId> all = comm.all_gather_values(std::span<const GlobalNodeId>(own));
  return {all.begin(), all.end()};
}

/// The pairs of a mesh with the partners of their nodes.
class PairMatcher {
 public:
  PairMatcher(const Communicator& comm, const Geometry& geometry, const std::vector<PeriodicPair>& pairs,
              MeshResult& result)
      : comm_{comm}, result_{result}, chords_{smoother::chords_of(geometry)}, path_{chords_} {
    for (const PeriodicPair& pair : pairs) outlines_.emplace_back(geometry, pair);
    for (std::size_t i = 0; i < pairs.size(); ++i)
      matches_.emplace_back(pair_sides(comm, path_, outlines_[i], pairs[i], result.mesh), outlines_[i],
                            pairs[i]);
  }

  NodeFlags match() {
    Positions positions = agreed_positions();
    std::vector<EdgeSplit> splits;
    for (const PairMatch& match : matches_) match.append_splits(splits);
    std::set<Point> places;
    for (const NodeId node : ids_below(NodeId{size32(result_.mesh.points)})) {
      Point& p = result_.mesh.points[node.value()];
      const Point moved = position_in(positions, result_.mesh, node);
      if (std::exchange(p, moved) != moved) places.insert(moved);
    }
    for (const EdgeSplit& split : splits) places.insert(split.places.begin(), split.places.end());
    split_edges(comm_, std::move(splits), result_);
    NodeFlags changed(result_.mesh.points.size(), 0);
    for (const NodeId node : changed.ids()) changed[node] = places.contains(result_.mesh.point(node)) ? 1 : 0;
    report();
    return changed;
  }

 private:
  Positions agreed_positions() {
    while (true) {
      Positions positions;
      for (const PairMatch& match : matches_) match.append_positions(positions);
      const std::set<GlobalNodeId> vetoed = vetoed_nodes(comm_, result_.mesh, positions);
      bool changed = false;
      for (PairMatch& match : matches_) changed = match.reconsider(vetoed) || changed;
      if (!changed) return positions;
    }
  }

  void report() const {
    std::size_t joined = 0, all = 0;
    for (const PairMatch& match : matches_) joined += match.joined(), all += match.places();
    log::detail(fmt::format("periodic pairs: {} nodes on each side, {} of them added on one side", all,
                            all - joined));
  }

  const Communicator& comm_;
  MeshResult& result_;
  Geometry chords_;
  smoother::OutlinePath path_;
  std::vector<PairOutline> outlines_;
  std::vector<PairMatch> matches_;
};

}  // namespace

bool demand_sizes_of_partners(const Communicator& comm, const Geometry& geometry,
                              const std::vector<PeriodicPair>& pairs, const MeshResult& result,
                              DemandedSplits& splits) {
  if (pairs.empty()) return false;
  const Geometry chords = smoother::chords_of(geometry);
  const smoother::OutlinePath path(chords);
  std::vector<SplitDemand> demands;
  for (const PeriodicPair& pair : pairs) {
    const PairOutline outline(geometry, pair);
    const PairSides sides = pair_sides(comm, path, outline, pair, result.mesh);
    const auto from = sized_edges(sides.from, sides.from_arcs, cells_at_edges(comm, pair.from, result)),
               to = sized_edges(sides.to, sides.to_arcs, cells_at_edges(comm, pair.to, result));
    append_splits(from, to, demands);
    append_splits(to, from, demands);
  }
  if (demands.empty()) return false;
  log::detail(
      fmt::format("{} cells at periodic boundaries are larger than opposite ones; the mesh is made again",
                  demands.size()));
  if (!comm.is_root()) demands.clear();  // all ranks have the same
  splits = DemandedSplits(comm, demands, splits);
  return true;
}

NodeFlags match_pairs(const Communicator& comm, const Geometry& geometry,
                      const std::vector<PeriodicPair>& pairs, MeshResult& result) {
  return PairMatcher(comm, geometry, pairs, result).match();
}

void place_images(const Communicator& comm, const std::vector<PeriodicPair>& pairs, Mesh& mesh) {
  if (pairs.empty()) return;
  constexpr double allowed = 0.2;  // of the shorter edge there: columns of layers may lean otherwise
  Positions positions;
  for (const PeriodicPair& pair : pairs) {
    const auto from = line_of_boundary(comm, mesh, pair.from);
    auto to = line_of_boundary(comm, mesh, pair.to);
    const bool match = from && to && from->nodes.size() == to->nodes.size();
    for (std::size_t i = 1; match && i + 1 < from->nodes.size(); ++i) {
      const std::size_t k = to->nodes.size() - 1 - i;
      const Point p = pair.image(from->points[i]), old = to->points[k];
      const double edge = std::min(length(to->points[k + 1] - old), length(to->points[k - 1] - old));
      if (length(p - old) <= allowed * edge) positions[to->nodes[k]] = p;
    }
  }
  for (const NodeId node : ids_below(NodeId{size32(mesh.points)}))
    mesh.points[node.value()] = position_in(positions, mesh, node);
  for (const PeriodicPair& pair : pairs) {
    if (const auto fault = fault_of_pair(comm, mesh, pair))
      throw InputError(fault->what +
                       "; use smaller cells there, or thinner layers on the walls that end there");
  }
}

}  // namespace quadloop
