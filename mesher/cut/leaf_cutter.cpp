#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/base/short_lists.hpp"
#include "mesher/cut/cut_leaf.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

/// Maximum distance of the boundary from its chord, relative to the leaf's edge.
constexpr double stray_of_leaf = 0.15;
constexpr double stray_of_chord = 0.2;  ///< and relative to the chord

/// A coordinate that ascends counter-clockwise along a side.
double along(Side side, Point p) {
  const double ascending = is_vertical(side) ? p.y : p.x;
  return side == Side::bottom || side == Side::right ? ascending : -ascending;
}

constexpr std::size_t few = 32;  ///< up to this number a linear search is faster than sorting

/// Finds the present edges of a list by their ends, as long as these do not change.
class EdgesByEnds {
 public:
  explicit EdgesByEnds(std::span<const CutLeaf::Edge> edges) : edges_{edges}, count_{edges.size()} {
    if (count_ <= few) return;
    order_.resize(count_);
    std::iota(order_.begin(), order_.end(), 0);
    std::ranges::sort(order_, {}, [&](std::int32_t e) { return std::tuple(edges[e].from, edges[e].to, e); });
    for (const std::int32_t e : order_) sorted_.emplace_back(edges[e].from, edges[e].to);
  }
  std::size_t count() const { return count_; }

  /// Returns the first edge between two nodes; the number of edges if there is none.
  std::size_t first(std::int32_t from, std::int32_t to) const {
    const auto runs_so = [&](std::size_t e) { return edges_[e].from == from && edges_[e].to == to; };
    const std::pair ends(from, to);
    std::size_t k = std::ranges::lower_bound(sorted_, ends) - sorted_.begin();
    for (; k < sorted_.size() && sorted_[k] == ends; ++k) {
      if (runs_so(order_[k])) return order_[k];
    }
    std::size_t e = order_.empty() ? 0 : count_;
    while (e < count_ && !runs_so(e)) ++e;
    return e;
  }

 private:
  std::span<const CutLeaf::Edge> edges_;
  std::size_t count_;
  std::vector<std::int32_t> order_;  ///< empty if there are few
  std::vector<std::pair<std::int32_t, std::int32_t>> sorted_;
};

/// In the order of Corner.
std::array<Point, 4> corners_of(const Box& box) {
  return {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}};
}

using Input = LeafCutter::Input;

/// A corner of the leaf, a hanging node, a crossing, or a point where a snap bends a side.
struct Stop {
  Side side = Side::bottom;
  double along = 0;  ///< ascending counter-clockwise
  Point position;    ///< before any snap
  Site site = Site::on_bottom;
  std::int32_t crossing = -1;
  std::int32_t snap = -1;  ///< one of the leaf's snaps, where the side bends through a feature point
  std::int32_t node = -1;  ///< invalid before name_stops()
};

void add_stop(const Box& box, Stop stop, std::pmr::vector<Stop>& stops) {
  if (stop.position == corners_of(box)[index_of(start_of(next(stop.side)))]) stop.side = next(stop.side);
  stop.along = along(stop.side, stop.position);
  if (!is_on_grid(stop.site)) stop.site = elsewhere_on(stop.side);
  stops.push_back(stop);
}

/// Whether a vertex is an end of a segment between two blocks.
bool is_on_interface(const Geometry& geometry, std::int32_t v) {
  return geometry.has_twins() && (geometry.twin(v) >= 0 || geometry.twin(geometry.previous(v)) >= 0);
}

/// Whether the leaf across a side has the vertex on it, too. It has not where the domain ends along the side.
bool is_shared(const Geometry& geometry, std::int32_t v, Side side) {
  const Point p = geometry.point(v);
  const std::int32_t before = geometry.previous(v);
  bool ends = false;
  for (const auto& [segment, far] : {std::pair(before, before), std::pair(v, geometry.next(v))}) {
    const Point q = geometry.point(far);
    if (is_vertical(side) ? q.x != p.x : q.y != p.y) continue;
    if (geometry.twin(segment) >= 0) return true;
    ends = true;
  }
  return !ends;
}

/// Whether a point is at the snapped vertex before it moved, and is where it moves, up to rounding.
bool touches(const Snap& snap, Point p) {
  const double rounding = 1e-9 * snap.radius;
  return length(p - snap.position) < rounding && length(p - snap.centre) < rounding;
}

/// The side of the leaf that holds the point, without its corners, if any.
std::optional<Side> side_at(const Box& box, Point p) {
  const bool on_x = p.x == box.low.x || p.x == box.high.x, on_y = p.y == box.low.y || p.y == box.high.y;
  if (on_x == on_y) return std::nullopt;
  if (on_y) return p.y == box.low.y ? Side::bottom : Side::top;
  return p.x == box.low.x ? Side::left : Side::right;
}

/// Returns corners, hanging nodes, crossings and kept points between blocks in their order around the leaf.
std::pmr::vector<Stop> stops_round(const Geometry& geometry, const Input& input,
                                   std::pmr::memory_resource* memory) {
  const Box& box = input.trace.box;
  const Point centre = input.centre;
  const std::array<Point, 4> corner = corners_of(box);
  const std::array<Point, 4> middle{
      Point{centre.x, box.low.y}, {box.high.x, centre.y}, {centre.x, box.high.y}, {box.low.x, centre.y}};
  std::pmr::vector<Stop> stops(memory);
  stops.reserve(8 + input.trace.crossings.size() + input.snaps.size());
  const auto add = [&](Side side, Point position, Site site, std::int32_t crossing, std::int32_t snap) {
    add_stop(box, {side, 0, position, site, crossing, snap}, stops);
  };
  for (const Side side : all_sides) {
    add(side, corner[index_of(start_of(side))], start_of(side), -1, -1);
    if (input.hanging.contains(side)) add(side, middle[index_of(side)], middle_of(side), -1, -1);
    for (std::int32_t c = 0; c < std::ssize(input.trace.crossings); ++c) {
      const Crossing& crossing = input.trace.crossings[c];
      if (crossing.side == side) add(side, crossing.position, elsewhere_on(side), c, -1);
    }
  }
  for (std::int32_t s = 0; s < std::ssize(input.snaps); ++s) {
    const Site site = input.snaps[s].site;
    if (is_on_grid(site)) continue;
    const Side side = side_of(site);
    const Point p = input.snaps[s].snap->position, from = corner[index_of(start_of(side))];
    add(side, is_vertical(side) ? Point{from.x, p.y} : Point{p.x, from.y}, site, -1, s);
  }
  for (const std::int32_t v : geometry.has_twins() ? input.trace.vertices : std::span<const std::int32_t>()) {
    const Point p = geometry.point(v);
    const std::optional<Side> side = side_at(box, p);
    const auto is_there = [&](const LeafSnap& one) {
      return one.snap->position == p || touches(*one.snap, p);
    };
    if (side && geometry.kept(v) && is_on_interface(geometry, v) && is_shared(geometry, v, *side) &&
        std::ranges::none_of(input.snaps, is_there))
      add(*side, p, elsewhere_on(*side), -1, -1);
  }
  const auto comes_first = [](const Stop& a, const Stop& b) {
    return a.side != b.side     ? a.side < b.side
           : a.along != b.along ? a.along < b.along
           : a.site != b.site   ? a.site < b.site
                                : a.crossing < b.crossing;
  };
  // With one crossing on a side they are already sorted.
  if (!std::is_sorted(stops.begin(), stops.end(), comes_first))
    std::sort(stops.begin(), stops.end(), comes_first);
  return stops;
}

/// The snap and the node of a crossing.
struct NamedCrossing {
  std::int32_t snap = -1;  ///< snap of the leaf that absorbs it
  std::int32_t node = -1;
};

/// Returns the number of the snap that absorbs the crossing; -1 for none. Where a boundary between two blocks
/// touches a grid line up to rounding, only the segments of one block cross it, and the snap was chosen from
/// those of the other block: it absorbs both.
std::int32_t absorbing_snap(const Geometry& geometry, std::span<const LeafSnap> snaps,
                            const Crossing& crossing) {
  for (const LeafSnap& s : snaps) {
    if (!sides_of(s.site).contains(crossing.side)) continue;
    const Snap::Absorbed wanted{crossing.segment, is_vertical(crossing.side)};
    const bool between_blocks = geometry.twin(crossing.segment) >= 0;
    if (std::ranges::binary_search(s.snap->absorbed, wanted) ||
        (between_blocks && touches(*s.snap, crossing.position)))
      return static_cast<std::int32_t>(&s - snaps.data());
  }
  return -1;
}

/// Adds a node for each position with a stop that no snap absorbs. Returns the node that each snap moves:
/// that of its grid site, or of its stop on a side.
std::pmr::vector<std::int32_t> add_side_nodes(std::span<const LeafSnap> snaps,
                                              std::span<const NamedCrossing> crossings,
                                              std::pmr::vector<Stop>& stops,
                                              std::vector<CutLeaf::Node>& nodes) {
  std::array<std::int32_t, grid_sites.size()> site_nodes{};
  std::pmr::vector<std::int32_t> snap_nodes(snaps.size(), -1, stops.get_allocator());
  for (std::size_t i = 0; i < stops.size(); ++i) {
    Stop& stop = stops[i];
    if (stop.crossing >= 0 && crossings[stop.crossing].snap >= 0) continue;
    const bool at_last = i > 0 && stops[i - 1].position == stop.position && stops[i - 1].node >= 0;
    if (!at_last) nodes.push_back({stop.position, stop.site});
    stop.node = size32(nodes) - 1;
    if (is_on_grid(stop.site)) site_nodes[index_of(stop.site)] = stop.node;
    if (stop.snap >= 0) snap_nodes[stop.snap] = stop.node;
  }
  for (std::size_t s = 0; s < snaps.size(); ++s) {
    if (is_on_grid(snaps[s].site)) snap_nodes[s] = site_nodes[index_of(snaps[s].site)];
  }
  return snap_nodes;
}

/// Assigns one node to all stops at the same position, and to a snapped corner with the crossings that it
/// absorbs. A node is moved by its snap only after all its stops have been found.
std::pmr::vector<NamedCrossing> name_stops(const Geometry& geometry, const Input& input,
                                           std::pmr::vector<Stop>& stops, CutLeaf& leaf) {
  std::pmr::vector<NamedCrossing> crossings(stops.get_allocator());
  crossings.reserve(input.trace.crossings.size());
  for (const Crossing& crossing : input.trace.crossings)
    crossings.push_back({absorbing_snap(geometry, input.snaps, crossing)});
  const std::pmr::vector<std::int32_t> snap_nodes = add_side_nodes(input.snaps, crossings, stops, leaf.nodes);
  for (Stop& stop : stops) {
    if (stop.crossing < 0) continue;
    NamedCrossing& crossing = crossings[stop.crossing];
    if (stop.node < 0) stop.node = snap_nodes[crossing.snap];
    crossing.node = stop.node;
  }
  for (std::size_t s = 0; s < input.snaps.size(); ++s)
    leaf.nodes[snap_nodes[s]].position = input.snaps[s].snap->position;
  leaf.side_nodes = size32(leaf.nodes);
  return crossings;
}

constexpr std::int32_t outside = -1;  ///< instead of a block

/// The changes of the blocks beside a side at one position, in the direction around the leaf: the block on
/// the left of a boundary that leaves the leaf begins, that of one that enters ends.
class BlockChanges {
 public:
  BlockChanges(const Geometry& geometry, const Input& input, std::pmr::memory_resource* memory)
      : geometry_{geometry}, input_{input}, changes_(memory) {}

  void clear() { changes_.clear(); }
  void add(std::int32_t crossing) {
    const Crossing& c = input_.trace.crossing(crossing);
    const std::int32_t block = geometry_.block_of(c.segment), by = c.enters ? -1 : 1;
    const auto known = std::ranges::find(changes_, block, &Change::block);
    if (known == changes_.end())
      changes_.push_back({block, by});
    else
      known->by += by;
  }
  /// The block with a net change; `outside` if there is none.
  std::int32_t with(int change) const {
    const auto found = std::ranges::find(changes_, change, &Change::by);
    return found == changes_.end() ? outside : found->block;
  }
  bool none() const {
    return std::ranges::all_of(changes_, [](const Change& c) { return c.by == 0; });
  }
  /// Whether they are possible after a part of a side in this block: it ends, or none ends and the part was
  /// outside.
  bool follow(std::int32_t block) const { return none() || with(-1) == block; }
  bool consistent() const {
    return std::ranges::all_of(changes_, [](const Change& c) { return std::abs(c.by) <= 1; });
  }

 private:
  struct Change {
    std::int32_t block;
    int by;
  };
  const Geometry& geometry_;
  const Input& input_;
  std::pmr::vector<Change> changes_;
};

/// The block just before the first stop (counter-clockwise), or `outside`; empty if crossings at one position
/// are inconsistent.
std::optional<std::int32_t> block_at_start(const Input& input, std::span<const Stop> stops,
                                           const Interior& inside, BlockChanges& changes) {
  for (std::size_t i = 0; i < stops.size();) {
    changes.clear();
    const Point position = stops[i].position;
    for (; i < stops.size() && stops[i].position == position; ++i) {
      if (stops[i].crossing >= 0) changes.add(stops[i].crossing);
    }
    if (changes.none()) continue;
    if (!changes.consistent()) return std::nullopt;
    return changes.with(-1);
  }
  // Every crossing coincides with an opposite one: all parts of the sides between them have the same state.
  // The midpoint of the longest part is used, as others may be as short as rounding.
  Point from, to;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    const Point p = stops[i].position, q = stops[(i + 1) % stops.size()].position;
    if (length(q - p) > length(to - from)) from = p, to = q;
  }
  const Point middle = 0.5 * (from + to);
  if (!(input.inside ? *input.inside : inside.contains(middle))) return outside;
  return input.inside ? input.block : inside.block_at(middle);
}

/// The parts of the sides.
struct Sides {
  explicit Sides(std::pmr::memory_resource* memory) : inside(memory), outside(memory) {}
  std::pmr::vector<CutLeaf::Edge> inside, outside;  ///< relative to the domain
  CutLeaf::InsideHalves halves;
};

/// Records a part of a side, from one stop to the next, that lies in the domain.
void note_side(Point centre, const Stop& from, const Stop& to, CutLeaf::InsideHalves& halves) {
  const double middle = along(from.side, centre);
  if (from.along < middle) halves.first.add(from.side);
  if (to.side != from.side || to.along > middle) halves.second.add(from.side);
}

/// In the direction around the leaf, a block follows its boundary that leaves the leaf and precedes one that
/// enters. Empty if this is inconsistent.
std::optional<Sides> walk_sides(const Geometry& geometry, const Input& input,
                                const std::pmr::vector<Stop>& stops, const Interior& interior) {
  BlockChanges changes(geometry, input, stops.get_allocator().resource());
  std::optional<std::int32_t> block = block_at_start(input, stops, interior, changes);
  if (!block) return std::nullopt;
  Sides sides(stops.get_allocator().resource());
  sides.inside.reserve(2 * stops.size());  // chords are added
  changes.clear();
  for (std::size_t i = 0; i < stops.size(); ++i) {
    const Stop &here = stops[i], &next = stops[(i + 1) % stops.size()];
    if (here.crossing >= 0) changes.add(here.crossing);
    if (here.position == next.position) continue;
    if (!changes.consistent() || !changes.follow(*block)) return std::nullopt;
    if (!changes.none()) block = changes.with(1);
    changes.clear();
    if (*block != outside) note_side(input.centre, here, next, sides.halves);
    if (here.node == next.node) continue;
    if (*block != outside)
      sides.inside.push_back({here.node, next.node, -1, *block});
    else
      sides.outside.push_back({here.node, next.node, -1});
  }
  return sides;
}

/// A point of a piece: its entry, a vertex, a hanging node moved onto it, or its exit.
struct RunPoint {
  Point position;
  std::int32_t segment = -1;  ///< segment that begins or continues here
  bool turns = false;         ///< whether the boundary turns here
  bool fixed = false;         ///< whether a chord must end here
  bool chosen = false;        ///< whether a chord ends here
  bool on_side = false;       ///< of a segment between blocks on a side: the leaf across has no node here
};

/// Creates the chords of a leaf whose sides have their nodes.
class ChordMaker {
 public:
  ChordMaker(const Geometry& geometry, const Input& input, std::span<const NamedCrossing> crossings,
             Detail detail, CutLeaf& leaf, std::pmr::memory_resource* memory)
      : geometry_{geometry},
        input_{input},
        crossings_{crossings},
        detail_{detail},
        largest_stray_{stray_of_leaf * input.trace.box.width()},
        leaf_{leaf},
        memory_{memory} {}

  /// Adds the chords of one piece: from its entry via the chosen points to its exit, for one boundary. A
  /// piece absorbed by a snapped corner has none, unless it is the way along an inner line and back.
  void add(const Piece& piece) {
    const bool closed = piece.entry < 0;
    if (!closed) {
      const LeafSnap *entry = snap_of(piece.entry), *exit = snap_of(piece.exit);
      const bool to_tip = is_way_to_tip(piece);
      if (entry != nullptr && exit != nullptr && entry->snap == exit->snap && !to_tip) return;
    }
    std::pmr::vector<RunPoint> run = points_of(piece);
    choose_points(closed, run);
    std::size_t from = 0;
    std::int32_t from_node = closed ? node_at(run[0].position) : crossings_[piece.entry].node;
    for (std::size_t i = 1; i < run.size(); ++i) {
      if (!run[i].chosen) continue;
      const bool at_exit = !closed && i + 1 == run.size();
      const std::int32_t to_node = at_exit ? crossings_[piece.exit].node : node_at(run[i].position);
      if (from_node != to_node)
        leaf_.outline.push_back(
            {from_node, to_node, run[from].segment, geometry_.block_of(run[from].segment)});
      from = i;
      from_node = to_node;
    }
  }

 private:
  /// Whether a piece leaves the leaf where it came in, along the twin.
  bool is_way_to_tip(const Piece& piece) const {
    const auto segment = [&](std::int32_t c) { return input_.trace.crossing(c).segment; };
    return geometry_.has_inner_lines() && geometry_.twin(segment(piece.entry)) == segment(piece.exit);
  }

  /// Returns the snap that absorbs the crossing; null if there is none.
  const LeafSnap* snap_of(std::int32_t crossing) const {
    const std::int32_t snap = crossings_[crossing].snap;
    return snap < 0 ? nullptr : &input_.snaps[snap];
  }

  /// Returns a piece's vertices without those at its ends that are absorbed by snapped corners.
  std::span<const std::int32_t> trimmed_vertices(const Piece& piece) const {
    auto vertices = input_.trace.vertices_of(piece);
    if (piece.entry < 0) return vertices;
    const auto vanishes = [&](const LeafSnap& s, std::int32_t v) {
      return length(geometry_.point(v) - s.snap->centre) < s.snap->radius;
    };
    if (const LeafSnap* entry = snap_of(piece.entry)) {
      while (!vertices.empty() && vanishes(*entry, vertices.front())) vertices = vertices.subspan(1);
    }
    if (const LeafSnap* exit = snap_of(piece.exit)) {
      while (!vertices.empty() && vanishes(*exit, vertices.back()))
        vertices = vertices.first(vertices.size() - 1);
    }
    return vertices;
  }

  /// Returns the points of a piece in order.
  std::pmr::vector<RunPoint> points_of(const Piece& piece) const {
    const bool closed = piece.entry < 0;
    const std::span<const std::int32_t> vertices = trimmed_vertices(piece);
    const auto node_position = [&](std::int32_t c) { return leaf_.nodes[crossings_[c].node].position; };
    std::pmr::vector<RunPoint> run(memory_);
    run.reserve(vertices.size() + 2);
    if (!closed) {
      const auto all = input_.trace.vertices_of(piece);
      const auto trimmed = vertices.data() - all.data();  // number of vertices removed at the start
      run.push_back(
          {node_position(piece.entry), trimmed == 0 ? piece.first_segment : all[trimmed - 1], true, true});
    }
    for (const std::int32_t v : vertices) {
      const Point p = geometry_.point(v);
      if (!run.empty()) add_hanging_nodes(p, run);
      const bool holds_node = std::any_of(input_.snaps.begin(), input_.snaps.end(),
                                          [&](const LeafSnap& s) { return s.snap->position == p; });
      const bool of_side = is_side_node(v);
      run.push_back({p, v, !geometry_.straight(v) || of_side, geometry_.kept(v) || holds_node || of_side,
                     false, !of_side && geometry_.twin(v) >= 0 && side_at(input_.trace.box, p)});
    }
    const Point last = closed ? run.front().position : node_position(piece.exit);
    add_hanging_nodes(last, run);
    run.push_back({last, -1, true, true});
    return run;
  }

  /// Whether a vertex between two blocks is a node of the leaf's sides: a twin may cross the side there.
  bool is_side_node(std::int32_t v) const {
    if (geometry_.twin(v) < 0) return false;
    const auto sides = std::span(leaf_.nodes).first(leaf_.side_nodes);
    return std::ranges::any_of(sides,
                               [&](const CutLeaf::Node& n) { return n.position == geometry_.point(v); });
  }

  /// Adds hanging nodes that were moved onto the segment from the last point of the run; between two blocks
  /// also those that lie on it.
  void add_hanging_nodes(Point segment_end, std::pmr::vector<RunPoint>& run) const {
    const RunPoint start = run.back();
    const std::size_t first = run.size();
    const std::int32_t twin = geometry_.twin(start.segment);
    const auto add = [&](Point p) {
      if (p != start.position && p != segment_end) run.push_back({p, start.segment, true, true});
    };
    for (const LeafSnap& s : input_.snaps) {
      const std::int32_t segment = s.snap->segment;
      if (is_middle(s.site) && segment >= 0 && (segment == start.segment || segment == twin))
        add(s.snap->position);
    }
    for (std::int32_t n = 0; twin >= 0 && n < leaf_.side_nodes; ++n) {
      const CutLeaf::Node& node = leaf_.nodes[n];
      const bool known = std::any_of(run.begin() + static_cast<std::ptrdiff_t>(first), run.end(),
                                     [&](const RunPoint& r) { return r.position == node.position; });
      if (is_middle(node.site) && !known && on_segment(node.position, start.position, segment_end))
        add(node.position);
    }
    std::sort(run.begin() + first, run.end(), [&](const RunPoint& a, const RunPoint& b) {
      return length(a.position - start.position) < length(b.position - start.position);
    });
  }

  /// Chooses the points of a piece that the chords pass through.
  void choose_points(bool closed, std::span<RunPoint> run) {
    leaf_.refined = leaf_.refined || closed;
    run.front().chosen = run.back().chosen = true;
    if (closed || detail_ != Detail::merged) {
      for (RunPoint& p : run) p.chosen = p.chosen || p.turns || (detail_ == Detail::exact && !p.on_side);
      return;
    }
    std::size_t from = 0;
    for (std::size_t i = 1; i < run.size(); ++i) {
      if (!run[i].fixed) continue;
      run[i].chosen = true;
      keep_strays(run.subspan(from, i - from + 1));
      from = i;
    }
  }

  /// Keeps the points between the first and the last one from which the chord would deviate too far (Douglas
  /// and Peucker 1973). Of equally distant points the first along the boundary is kept; a mirror image has
  /// the opposite direction and keeps the other one.
  void keep_strays(std::span<RunPoint> run) {
    if (run.size() < 3) return;
    const Point a = run.front().position, b = run.back().position;
    std::size_t farthest = 0;
    const bool last_of_equal = geometry_.is_second(run.front().segment);  // the run of its twins is reversed
    double stray = a == b ? largest_stray_ / 2 : std::min(largest_stray_, stray_of_chord * length(b - a));
    for (std::size_t i = 1; i + 1 < run.size(); ++i) {
      const double distance = distance_to_segment(run[i].position, a, b);
      if (!run[i].turns || distance < stray || (distance == stray && !(last_of_equal && farthest > 0)))
        continue;
      stray = distance;
      farthest = i;
    }
    if (farthest == 0) return;
    run[farthest].chosen = true;
    leaf_.refined = true;
    keep_strays(run.first(farthest + 1));
    keep_strays(run.subspan(farthest));
  }

  /// Returns the node at the position, if it is among the first few; settle_inner_nodes() finds the others.
  std::int32_t node_at(Point position) {
    const auto looked_at = static_cast<std::int32_t>(std::min(leaf_.nodes.size(), few));
    for (std::int32_t i = 0; i < looked_at; ++i) {
      if (leaf_.nodes[i].position == position) return i;
    }
    leaf_.nodes.push_back({position, Site::inside});
    return size32(leaf_.nodes) - 1;
  }

  const Geometry& geometry_;
  const Input& input_;
  std::span<const NamedCrossing> crossings_;
  Detail detail_;
  double largest_stray_;
  CutLeaf& leaf_;
  std::pmr::memory_resource* memory_;
};

/// Merges inner nodes at the same position, also with one on the sides. The others are sorted by position:
/// their order must not depend on the order of the boundaries.
void settle_inner_nodes(CutLeaf& leaf, std::pmr::memory_resource* memory) {
  const std::int32_t first = leaf.side_nodes;
  const bool all_looked_at = leaf.nodes.size() <= few;
  if (size32(leaf.nodes) <= first + (all_looked_at ? 1 : 0)) return;
  std::pmr::vector<std::int32_t> order(leaf.nodes.size(), memory), renamed(leaf.nodes.size(), memory);
  std::pmr::vector<CutLeaf::Node> inner(memory);
  std::iota(order.begin(), order.end(), 0);
  const auto position = [&](std::int32_t i) { return leaf.nodes[i].position; };
  std::ranges::sort(order, {}, [&](std::int32_t i) { return std::pair(position(i), i); });
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    const bool on_side = order[begin] < first;
    const std::int32_t name = on_side ? order[begin] : first + size32(inner);
    if (!on_side) inner.push_back(leaf.nodes[order[begin]]);
    for (; end < order.size() && position(order[end]) == position(order[begin]); ++end)
      renamed[order[end]] = order[end] < first ? order[end] : name;
  }
  leaf.nodes.resize(first);
  leaf.nodes.insert(leaf.nodes.end(), inner.begin(), inner.end());
  for (auto& edge : leaf.outline) {
    edge.from = renamed[edge.from];
    edge.to = renamed[edge.to];
  }
  std::erase_if(leaf.outline, [](const CutLeaf::Edge& e) { return e.from == e.to; });
}

/// Whether two opposite chords, or a chord along a side, may have cells on both sides.
bool is_two_sided(const Geometry& geometry, const CutLeaf& leaf, const CutLeaf::Edge& chord,
                  const CutLeaf::Edge* opposite) {
  if (geometry.twin(chord.segment) < 0) return opposite == nullptr;
  if (opposite != nullptr)
    return geometry.twin(opposite->segment) >= 0 &&
           geometry.boundary_of(geometry.twin(opposite->segment)) == geometry.boundary_of(chord.segment) &&
           geometry.is_second(opposite->segment) != geometry.is_second(chord.segment);
  return !(sides_of(leaf.nodes[chord.from].site) & sides_of(leaf.nodes[chord.to].site)).empty();
}

/// Cancels a chord along a side of the leaf against that side: neither bounds a cell here. Returns false for
/// two opposite chords, which would lose what lies between them, unless they are those of two-sided segments.
bool cancel_opposites(const Geometry& geometry, const CutLeaf& leaf, std::pmr::vector<CutLeaf::Edge>& edges) {
  const std::span<const CutLeaf::Edge> outline = leaf.outline;
  edges.reserve(edges.size() + outline.size());  // avoids reallocation of the side edges
  const EdgesByEnds chords(outline), sides(edges);
  const auto of_block = [&](std::size_t side, const CutLeaf::Edge& chord) {
    return side < sides.count() && edges[side].block == chord.block ? side : sides.count();
  };
  for (const CutLeaf::Edge& chord : outline) {
    const std::size_t opposite = chords.first(chord.to, chord.from);
    const bool is_way_back = opposite < chords.count() && outline[opposite].block == chord.block;
    if (!is_two_sided(geometry, leaf, chord, opposite < chords.count() ? &outline[opposite] : nullptr))
      return false;
    const std::size_t along = of_block(sides.first(chord.from, chord.to), chord),
                      against = of_block(sides.first(chord.to, chord.from), chord);
    if (along < against && !is_way_back) return false;  // the way back cancels the side
    if (against == sides.count()) {
      edges.push_back(chord);
    } else {
      edges[against].from = edges[against].to = -1;
    }
  }
  std::erase_if(edges, [](const CutLeaf::Edge& e) { return e.from < 0; });
  return true;
}

/// Whether the chords need no checks: one part of the boundary was merged into one chord between two sides.
bool is_simple(const Input& input, const CutLeaf& leaf) {
  const auto& crossings = input.trace.crossings;
  return input.snaps.empty() && input.trace.pieces.size() == 1 && leaf.outline.size() == 1 &&
         crossings.size() == 2 && crossings[0].side != crossings[1].side;
}

}  // namespace

bool LeafCutter::cut(const Input& input, Detail detail) {
  leaf_.nodes.clear();
  leaf_.outline.clear();
  leaf_.loop_nodes.clear();
  leaf_.loop_starts.assign(1, 0);
  leaf_.loop_blocks.clear();
  leaf_.refined = false;
  ShortLists<4096> lists;
  std::pmr::vector<Stop> stops = stops_round(outline_->geometry(), input, lists.memory());
  const std::pmr::vector<NamedCrossing> crossings = name_stops(outline_->geometry(), input, stops, leaf_);
  std::optional<Sides> sides = walk_sides(outline_->geometry(), input, stops, *inside_);
  if (!sides) return false;
  leaf_.inside_halves = sides->halves;
  ChordMaker chords(outline_->geometry(), input, crossings, detail, leaf_, lists.memory());
  for (const Piece& piece : input.trace.pieces) chords.add(piece);
  settle_inner_nodes(leaf_, lists.memory());
  std::pmr::vector<CutLeaf::Edge>& edges = sides->inside;
  const bool simple = is_simple(input, leaf_);
  if (!cancel_opposites(outline_->geometry(), leaf_, edges) || !trace_loops(edges, leaf_)) return false;
  return simple || (loops_are_sound(edges, leaf_) &&
                    (input.snaps.empty() || sides_are_sound(edges, sides->outside, leaf_)));
}

}  // namespace quadloop
