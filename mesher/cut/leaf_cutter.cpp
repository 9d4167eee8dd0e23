#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/cut/cut_leaf.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"

namespace quadloop {

namespace {

/// How far the outline may lie from its chord, as a share of the leaf's edge.
constexpr double stray_of_leaf = 0.15;
constexpr double stray_of_chord = 0.2;  ///< and as a share of the chord

/// A coordinate that ascends counter-clockwise along a side.
double along(Side side, Point p) {
  const double ascending = is_vertical(side) ? p.y : p.x;
  return side == Side::bottom || side == Side::right ? ascending : -ascending;
}

constexpr std::size_t few = 32;  ///< of so many all are looked at in less time than they are sorted

/// The edges that a list has now, by their ends, found as long as they keep these.
class EdgesByEnds {
 public:
  explicit EdgesByEnds(const std::vector<CutLeaf::Edge>& edges) : edges_{edges}, count_{edges.size()} {
    if (count_ <= few) return;
    order_.resize(count_);
    std::iota(order_.begin(), order_.end(), 0);
    std::ranges::sort(order_, {}, [&](std::int32_t e) { return std::tuple(edges[e].from, edges[e].to, e); });
    for (const std::int32_t e : order_) sorted_.emplace_back(edges[e].from, edges[e].to);
  }
  std::size_t count() const { return count_; }

  /// The first one from one node to another; their count where there is none.
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
  const std::vector<CutLeaf::Edge>& edges_;
  std::size_t count_;
  std::vector<std::int32_t> order_;  ///< none where they are few
  std::vector<std::pair<std::int32_t, std::int32_t>> sorted_;
};

/// By Corner.
std::array<Point, 4> corners_of(const Box& box) {
  return {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}};
}

}  // namespace

bool LeafCutter::cut(const Input& input, Detail detail) {
  input_ = input;
  leaf_.nodes.clear();
  leaf_.outline.clear();
  leaf_.loop_nodes.clear();
  leaf_.loop_starts.assign(1, 0);
  leaf_.refined = false;
  edges_.clear();
  bare_sides_.clear();
  largest_stray_ = stray_of_leaf * input_.trace.box.width();
  gather_stops();
  if (!walk_sides()) return false;
  add_chords(detail);
  settle_inner_nodes();
  const auto& crossings = input_.trace.crossings;
  const bool simple = input_.snaps.empty() && input_.trace.pieces.size() == 1 && leaf_.outline.size() == 1 &&
                      crossings.size() == 2 && crossings[0].side != crossings[1].side;
  if (!cancel_opposites() || !trace_loops(edges_, leaf_)) return false;
  return simple || (loops_are_sound(edges_, leaf_) &&
                    (input_.snaps.empty() || sides_are_sound(edges_, bare_sides_, leaf_)));
}

void LeafCutter::add_stop(Side side, Point position, Site site, std::int32_t crossing, std::int32_t snap) {
  if (position == corners_of(input_.trace.box)[index_of(start_of(next(side)))]) side = next(side);
  stops_.push_back({side, along(side, position), position, is_on_lattice(site) ? site : elsewhere_on(side),
                    crossing, snap});
}

/// Corners, hanging nodes and crossings in their order round the leaf, before any snap.
void LeafCutter::gather_stops() {
  stops_.clear();
  const Box& box = input_.trace.box;
  const Point centre = input_.centre;
  const std::array<Point, 4> corner = corners_of(box);
  const std::array<Point, 4> middle{
      Point{centre.x, box.low.y}, {box.high.x, centre.y}, {centre.x, box.high.y}, {box.low.x, centre.y}};
  for (const Side side : all_sides) {
    add_stop(side, corner[index_of(start_of(side))], start_of(side), -1);
    if (input_.hanging.contains(side)) add_stop(side, middle[index_of(side)], middle_of(side), -1);
    for (std::int32_t c = 0; c < std::ssize(input_.trace.crossings); ++c) {
      const Crossing& crossing = input_.trace.crossings[c];
      if (crossing.side == side) add_stop(side, crossing.position, elsewhere_on(side), c);
    }
  }
  for (std::int32_t s = 0; s < std::ssize(input_.snaps); ++s) {
    const Site site = input_.snaps[s].site;
    if (is_on_lattice(site)) continue;
    const Side side = side_of(site);
    const Point p = input_.snaps[s].snap->position, from = corner[index_of(start_of(side))];
    add_stop(side, is_vertical(side) ? Point{from.x, p.y} : Point{p.x, from.y}, site, -1, s);
  }
  const auto comes_first = [](const Stop& a, const Stop& b) {
    return a.side != b.side     ? a.side < b.side
           : a.along != b.along ? a.along < b.along
           : a.site != b.site   ? a.site < b.site
                                : a.crossing < b.crossing;
  };
  // With one crossing on a side they are in order.
  if (!std::is_sorted(stops_.begin(), stops_.end(), comes_first))
    std::sort(stops_.begin(), stops_.end(), comes_first);
  name_stops();
}

/// The number of the snap that takes the crossing; -1 for none.
std::int32_t LeafCutter::absorbing_snap(const Crossing& crossing) const {
  for (const LeafSnap& s : input_.snaps) {
    if (!sides_of(s.site).contains(crossing.side)) continue;
    const Snap::Absorbed wanted{crossing.segment, is_vertical(crossing.side)};
    if (std::ranges::binary_search(s.snap->absorbed, wanted))
      return static_cast<std::int32_t>(&s - input_.snaps.data());
  }
  return -1;
}

/// One node for all stops at one position, and for a snapped corner with the crossings that it absorbs. In
/// this order: a node is moved by its snap once all who share it have found it.
void LeafCutter::name_stops() {
  crossing_snap_.clear();
  for (const Crossing& crossing : input_.trace.crossings) crossing_snap_.push_back(absorbing_snap(crossing));
  stop_node_.assign(stops_.size(), -1);
  name_snaps(add_side_nodes());
  name_absorbed_stops();
  crossing_node_.assign(input_.trace.crossings.size(), -1);
  for (std::size_t i = 0; i < stops_.size(); ++i) {
    if (stops_[i].crossing >= 0) crossing_node_[stops_[i].crossing] = stop_node_[i];
  }
  for (std::size_t s = 0; s < input_.snaps.size(); ++s)
    leaf_.nodes[snap_node_[s]].position = input_.snaps[s].snap->position;
  leaf_.side_nodes = size32(leaf_.nodes);
}

/// A node for each position that has a stop which no snap absorbs; these nodes by their lattice sites.
LeafCutter::SiteNodes LeafCutter::add_side_nodes() {
  SiteNodes site_nodes{};
  for (std::size_t i = 0; i < stops_.size(); ++i) {
    const Stop& stop = stops_[i];
    if (stop.crossing >= 0 && crossing_snap_[stop.crossing] >= 0) continue;
    const bool at_last = i > 0 && stops_[i - 1].position == stop.position && stop_node_[i - 1] >= 0;
    if (!at_last) leaf_.nodes.push_back({stop.position, stop.site});
    stop_node_[i] = size32(leaf_.nodes) - 1;
    if (is_on_lattice(stop.site)) site_nodes[index_of(stop.site)] = stop_node_[i];
  }
  return site_nodes;
}

/// The node that each snap moves: that of its lattice site, or of its stop on a side.
void LeafCutter::name_snaps(const SiteNodes& site_nodes) {
  snap_node_.assign(input_.snaps.size(), -1);
  for (std::size_t i = 0; i < stops_.size(); ++i) {
    if (stops_[i].snap >= 0) snap_node_[stops_[i].snap] = stop_node_[i];
  }
  for (std::size_t s = 0; s < input_.snaps.size(); ++s) {
    if (is_on_lattice(input_.snaps[s].site)) snap_node_[s] = site_nodes[index_of(input_.snaps[s].site)];
  }
}

/// Crossings that a snap absorbs have its node.
void LeafCutter::name_absorbed_stops() {
  for (std::size_t i = 0; i < stops_.size(); ++i) {
    const std::int32_t c = stops_[i].crossing;
    if (c < 0 || stop_node_[i] >= 0) continue;
    stop_node_[i] = snap_node_[crossing_snap_[c]];
  }
}

/// Adds the parts of the sides that lie in the domain. Walking round the leaf, an outline that leaves it has
/// the domain after it, one that enters has it before. False where that does not come out even.
bool LeafCutter::walk_sides() {
  bool inside = false;
  if (!status_at_start(inside)) return false;
  leaf_.inside_halves = {};
  int status = inside ? 1 : 0;
  for (std::size_t i = 0; i < stops_.size(); ++i) {
    const std::size_t next = (i + 1) % stops_.size();
    const std::int32_t c = stops_[i].crossing;
    if (c >= 0) status += input_.trace.crossing(c).enters ? -1 : 1;
    if (stops_[i].position == stops_[next].position) continue;
    if (status != 0 && status != 1) return false;
    if (status == 1) note_side(stops_[i], stops_[next]);
    if (stop_node_[i] != stop_node_[next])
      (status == 1 ? edges_ : bare_sides_).push_back({stop_node_[i], stop_node_[next], -1});
  }
  return true;
}

/// A part of a side, from one stop to the next, lies in the domain.
void LeafCutter::note_side(const Stop& from, const Stop& to) {
  const double middle = along(from.side, input_.centre);
  if (from.along < middle) leaf_.inside_halves.first.add(from.side);
  if (to.side != from.side || to.along > middle) leaf_.inside_halves.second.add(from.side);
}

/// Whether the domain lies just before the first stop (counter-clockwise).
bool LeafCutter::status_at_start(bool& inside) const {
  for (std::size_t i = 0; i < stops_.size();) {
    int change = 0;
    const Point position = stops_[i].position;
    for (; i < stops_.size() && stops_[i].position == position; ++i) {
      if (stops_[i].crossing >= 0) change += input_.trace.crossing(stops_[i].crossing).enters ? -1 : 1;
    }
    if (change == 0) continue;
    inside = change < 0;
    return change == 1 || change == -1;
  }
  // Every crossing shares its place with its opposite: the parts of the sides between such places are all
  // alike. The middle of the longest is no end of it, even where others are as short as rounding.
  Point from, to;
  for (std::size_t i = 0; i < stops_.size(); ++i) {
    const Point p = stops_[i].position, q = stops_[(i + 1) % stops_.size()].position;
    if (length(q - p) > length(to - from)) from = p, to = q;
  }
  inside = input_.inside ? *input_.inside : inside_->contains(0.5 * (from + to));
  return true;
}

/// That at the position, if it is among the first few: settle_inner_nodes() finds the others.
std::int32_t LeafCutter::node_at(Point position) {
  const auto looked_at = static_cast<std::int32_t>(std::min(leaf_.nodes.size(), few));
  for (std::int32_t i = 0; i < looked_at; ++i) {
    if (leaf_.nodes[i].position == position) return i;
  }
  leaf_.nodes.push_back({position, Site::inside});
  return size32(leaf_.nodes) - 1;
}

void LeafCutter::add_chords(Detail detail) {
  for (const Piece& piece : input_.trace.pieces) add_chord_run(piece, detail);
}

/// The chords for one piece: from its entry over the kept points to its exit, one boundary each. A piece that
/// a snapped corner swallowed has none.
void LeafCutter::add_chord_run(const Piece& piece, Detail detail) {
  const bool closed = piece.entry < 0;
  if (!closed) {
    const LeafSnap *entry = snap_of(piece.entry), *exit = snap_of(piece.exit);
    if (entry != nullptr && exit != nullptr && entry->snap == exit->snap) return;
  }
  list_points(piece, trimmed_vertices(piece));
  choose_points(closed, detail);
  std::size_t from = 0;
  std::int32_t from_node = closed ? node_at(run_[0].position) : crossing_node_[piece.entry];
  for (std::size_t i = 1; i < run_.size(); ++i) {
    if (!run_[i].chosen) continue;
    const bool at_exit = !closed && i + 1 == run_.size();
    const std::int32_t to_node = at_exit ? crossing_node_[piece.exit] : node_at(run_[i].position);
    if (from_node != to_node) leaf_.outline.push_back({from_node, to_node, run_[from].segment});
    from = i;
    from_node = to_node;
  }
}

/// A piece's vertices without those next to its ends that vanish in snapped corners.
std::span<const std::int32_t> LeafCutter::trimmed_vertices(const Piece& piece) const {
  auto vertices = input_.trace.vertices_of(piece);
  if (piece.entry < 0) return vertices;
  const auto vanishes = [&](const LeafSnap& s, std::int32_t v) {
    return length(outline_->geometry().point(v) - s.snap->centre) < s.snap->radius;
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

/// Lists a piece's points in their order.
void LeafCutter::list_points(const Piece& piece, std::span<const std::int32_t> vertices) {
  const Geometry& g = outline_->geometry();
  const bool closed = piece.entry < 0;
  const auto node_position = [&](std::int32_t c) { return leaf_.nodes[crossing_node_[c]].position; };
  run_.clear();
  if (!closed) {
    const auto all = input_.trace.vertices_of(piece);
    const auto trimmed = vertices.data() - all.data();  // in front
    run_.push_back(
        {node_position(piece.entry), trimmed == 0 ? piece.first_segment : all[trimmed - 1], true, true});
  }
  for (const std::int32_t v : vertices) {
    if (!run_.empty()) add_hanging_nodes(g.point(v));
    const bool holds_node = std::any_of(input_.snaps.begin(), input_.snaps.end(),
                                        [&](const LeafSnap& s) { return s.snap->position == g.point(v); });
    run_.push_back({g.point(v), v, !g.straight(v), g.kept(v) || holds_node});
  }
  const Point last = closed ? run_.front().position : node_position(piece.exit);
  add_hanging_nodes(last);
  run_.push_back({last, -1, true, true});
}

/// Hanging nodes that were moved onto the segment from the last point of the run on come next.
void LeafCutter::add_hanging_nodes(Point segment_end) {
  const RunPoint start = run_.back();
  const std::size_t first = run_.size();
  for (const LeafSnap& s : input_.snaps) {
    const Point p = s.snap->position;
    if (!is_middle(s.site) || s.snap->segment != start.segment || p == start.position || p == segment_end)
      continue;
    run_.push_back({p, start.segment, true, true});
  }
  std::sort(run_.begin() + first, run_.end(), [&](const RunPoint& a, const RunPoint& b) {
    return length(a.position - start.position) < length(b.position - start.position);
  });
}

/// Chooses the points of a piece that the chords go through.
void LeafCutter::choose_points(bool closed, Detail detail) {
  leaf_.refined = leaf_.refined || closed;
  run_.front().chosen = run_.back().chosen = true;
  if (closed || detail != Detail::merged) {
    for (RunPoint& p : run_) p.chosen = p.chosen || p.turns || detail == Detail::exact;
    return;
  }
  std::size_t from = 0;
  for (std::size_t i = 1; i < run_.size(); ++i) {
    if (!run_[i].fixed) continue;
    run_[i].chosen = true;
    keep_strays(from, i);
    from = i;
  }
}

/// Keeps the points between two kept ones from which the chord would stray too far (the rule of Douglas and
/// Peucker 1973). Of points that are equally far the first along the outline is kept; a mirror image is
/// walked the other way, and keeps the other one.
void LeafCutter::keep_strays(std::size_t from, std::size_t to) {
  if (to - from < 2) return;
  const Point a = run_[from].position, b = run_[to].position;
  std::size_t farthest = from;
  double stray = a == b ? largest_stray_ / 2 : std::min(largest_stray_, stray_of_chord * length(b - a));
  for (std::size_t i = from + 1; i < to; ++i) {
    const double distance = distance_to_segment(run_[i].position, a, b);
    if (!run_[i].turns || distance <= stray) continue;
    stray = distance;
    farthest = i;
  }
  if (farthest == from) return;
  run_[farthest].chosen = true;
  leaf_.refined = true;
  keep_strays(from, farthest);
  keep_strays(farthest, to);
}

/// Makes one node of all inside at one position, or that on the sides if it has one. The others go by
/// position: their order must not depend on the order in which boundaries are listed.
void LeafCutter::settle_inner_nodes() {
  const std::int32_t first = leaf_.side_nodes;
  const bool all_looked_at = leaf_.nodes.size() <= few;
  if (size32(leaf_.nodes) <= first + (all_looked_at ? 1 : 0)) return;
  thread_local std::vector<std::int32_t> order, renamed;
  thread_local std::vector<CutLeaf::Node> inner;
  order.resize(leaf_.nodes.size());
  renamed.resize(leaf_.nodes.size());
  inner.clear();
  std::iota(order.begin(), order.end(), 0);
  const auto position = [&](std::int32_t i) { return leaf_.nodes[i].position; };
  std::ranges::sort(order, {}, [&](std::int32_t i) { return std::pair(position(i), i); });
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    const bool on_side = order[begin] < first;
    const std::int32_t name = on_side ? order[begin] : first + size32(inner);
    if (!on_side) inner.push_back(leaf_.nodes[order[begin]]);
    for (; end < order.size() && position(order[end]) == position(order[begin]); ++end)
      renamed[order[end]] = order[end] < first ? order[end] : name;
  }
  leaf_.nodes.resize(first);
  leaf_.nodes.insert(leaf_.nodes.end(), inner.begin(), inner.end());
  for (auto& edge : leaf_.outline) {
    edge.from = renamed[edge.from];
    edge.to = renamed[edge.to];
  }
  std::erase_if(leaf_.outline, [](const CutLeaf::Edge& e) { return e.from == e.to; });
}

/// A chord along a side of the leaf, against the sense of the side, leaves nothing between the two: neither
/// bounds a cell here. Two chords against each other would swallow what lies between: false.
bool LeafCutter::cancel_opposites() {
  const EdgesByEnds chords(leaf_.outline), sides(edges_);
  for (const CutLeaf::Edge& chord : leaf_.outline) {
    if (chords.first(chord.to, chord.from) < chords.count()) return false;
    const std::size_t along = sides.first(chord.from, chord.to), against = sides.first(chord.to, chord.from);
    if (along < against) return false;
    if (against == sides.count()) {
      edges_.push_back(chord);
    } else {
      edges_[against].from = edges_[against].to = -1;
    }
  }
  std::erase_if(edges_, [](const CutLeaf::Edge& e) { return e.from < 0; });
  return true;
}

}  // namespace quadloop
