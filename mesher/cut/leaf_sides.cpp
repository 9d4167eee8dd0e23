#include "mesher/cut/leaf_sides.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <span>
#include <utility>

#include "mesher/base/ids.hpp"

namespace quadloop {

namespace {

using Input = LeafCutter::Input;

/// A coordinate that ascends counter-clockwise along a side.
double along(Side side, Point p) {
  const double ascending = is_vertical(side) ? p.y : p.x;
  return side == Side::bottom || side == Side::right ? ascending : -ascending;
}

/// In the order of Corner.
std::array<Point, 4> corners_of(const Box& box) {
  return {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}};
}

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
  return length(p - snap.position) < rounding_at(snap) && length(p - snap.centre) < rounding_at(snap);
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
    if (is_on_grid(site) || site == Site::inside) continue;
    const Side side = side_of(site);
    const Point p = input.snaps[s].snap->position, from = corner[index_of(start_of(side))];
    add(side, is_vertical(side) ? Point{from.x, p.y} : Point{p.x, from.y}, site, -1, s);
  }
  for (const std::int32_t v : geometry.has_twins() ? input.trace.vertices : std::span<const std::int32_t>()) {
    const Point p = geometry.point(v);
    const std::optional<Side> side = side_at(box, p);
    const auto is_there = [&](const LeafSnap& one) {
      return touches(*one.snap, p) || (one.snap->position == p && is_between_blocks(geometry, v));
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

/// Whether the boundary crosses a side at a point where blocks meet.
bool is_where_blocks_meet(const Geometry& geometry, const Crossing& crossing) {
  const std::array<std::int32_t, 2> ends{crossing.segment, geometry.next(crossing.segment)};
  return std::ranges::any_of(ends, [&](std::int32_t v) {
    return geometry.point(v) == crossing.position && is_between_blocks(geometry, v);
  });
}

/// Returns the number of the snap that absorbs the crossing; -1 for none. Where a boundary between two blocks
/// touches a grid line up to rounding, or ends on it, only the segments of one block may cross it, and the
/// snap was chosen from those of the other block: it absorbs both.
std::int32_t absorbing_snap(const Geometry& geometry, std::span<const LeafSnap> snaps,
                            const Crossing& crossing) {
  for (const LeafSnap& s : snaps) {
    if (!sides_of(s.site).contains(crossing.side)) continue;
    const Snap::Absorbed wanted{crossing.segment, is_vertical(crossing.side)};
    const bool between_blocks = geometry.twin(crossing.segment) >= 0;
    if (std::ranges::binary_search(s.snap->absorbed, wanted) ||
        (between_blocks && touches(*s.snap, crossing.position)) ||
        (crossing.position == s.snap->position && is_where_blocks_meet(geometry, crossing)))
      return static_cast<std::int32_t>(&s - snaps.data());
  }
  return -1;
}

/// Adds a node for each position with a stop that no snap absorbs. Returns the node that each snap moves:
/// that of its grid site, or of its stop on a side; -1 for a snap inside the leaf.
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
  for (std::size_t s = 0; s < input.snaps.size(); ++s) {
    if (input.snaps[s].site != Site::inside)
      leaf.nodes[snap_nodes[s]].position = input.snaps[s].snap->position;
  }
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

/// Records a part of a side, from one stop to the next, that lies in the domain.
void note_side(Point centre, const Stop& from, const Stop& to, CutLeaf::InsideHalves& halves) {
  const double middle = along(from.side, centre);
  if (from.along < middle) halves.first.add(from.side);
  if (to.side != from.side || to.along > middle) halves.second.add(from.side);
}

/// In the direction around the leaf, a block follows its boundary that leaves the leaf and precedes one that
/// enters. Returns false if this is inconsistent.
bool walk_sides(const Geometry& geometry, const Input& input, const std::pmr::vector<Stop>& stops,
                const Interior& interior, DividedSides& sides) {
  BlockChanges changes(geometry, input, stops.get_allocator().resource());
  std::optional<std::int32_t> block = block_at_start(input, stops, interior, changes);
  if (!block) return false;
  sides.inside.reserve(2 * stops.size());  // chords are added
  changes.clear();
  for (std::size_t i = 0; i < stops.size(); ++i) {
    const Stop &here = stops[i], &next = stops[(i + 1) % stops.size()];
    if (here.crossing >= 0) changes.add(here.crossing);
    if (here.position == next.position) continue;
    if (!changes.consistent() || !changes.follow(*block)) return false;
    if (!changes.none()) block = changes.with(1);
    changes.clear();
    if (*block != outside) note_side(input.centre, here, next, sides.halves);
    if (here.node == next.node) continue;
    if (*block != outside)
      sides.inside.push_back({here.node, next.node, -1, *block});
    else
      sides.outside.push_back({here.node, next.node, -1});
  }
  return true;
}

}  // namespace

std::optional<DividedSides> divide_sides(const Geometry& geometry, const Input& input,
                                         const Interior& interior, std::pmr::memory_resource* memory,
                                         CutLeaf& leaf) {
  DividedSides sides(memory);
  std::pmr::vector<Stop> stops = stops_round(geometry, input, memory);
  sides.crossings = name_stops(geometry, input, stops, leaf);
  if (!walk_sides(geometry, input, stops, interior, sides)) return std::nullopt;
  return sides;
}

std::optional<Side> side_at(const Box& box, Point p) {
  const bool on_x = p.x == box.low.x || p.x == box.high.x, on_y = p.y == box.low.y || p.y == box.high.y;
  if (on_x == on_y) return std::nullopt;
  if (on_y) return p.y == box.low.y ? Side::bottom : Side::top;
  return p.x == box.low.x ? Side::left : Side::right;
}

}  // namespace quadloop
