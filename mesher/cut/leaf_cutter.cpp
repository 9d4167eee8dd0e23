#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "mesher/base/ids.hpp"
#include "mesher/base/short_lists.hpp"
#include "mesher/cut/cut_leaf.hpp"
#include "mesher/cut/leaf_sides.hpp"
#include "mesher/geometry/nearest_on_segment.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

/// Maximum distance of the boundary from its chord, relative to the leaf's edge.
constexpr double stray_of_leaf = 0.15;
constexpr double stray_of_chord = 0.2;  ///< and relative to the chord

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

using Input = LeafCutter::Input;

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

/// Adds a node for each snap inside the leaf, with a loop of this node alone, in the leaf's only block.
void add_lone_nodes(std::span<const LeafSnap> snaps, CutLeaf& leaf) {
  for (const LeafSnap& s : snaps) {
    if (s.site != Site::inside || leaf.loop_blocks.empty()) continue;
    leaf.loop_nodes.push_back(size32(leaf.nodes));
    leaf.loop_starts.push_back(size32(leaf.loop_nodes));
    leaf.loop_blocks.push_back(leaf.loop_blocks.front());
    leaf.nodes.push_back({s.snap->position, Site::inside});
  }
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
  const Geometry& geometry = outline_->geometry();
  std::optional<DividedSides> sides = divide_sides(geometry, input, *inside_, lists.memory(), leaf_);
  if (!sides) return false;
  leaf_.inside_halves = sides->halves;
  ChordMaker chords(geometry, input, sides->crossings, detail, leaf_, lists.memory());
  for (const Piece& piece : input.trace.pieces) chords.add(piece);
  settle_inner_nodes(leaf_, lists.memory());
  std::pmr::vector<CutLeaf::Edge>& edges = sides->inside;
  const bool simple = is_simple(input, leaf_);
  if (!cancel_opposites(geometry, leaf_, edges) || !trace_loops(edges, leaf_)) return false;
  add_lone_nodes(input.snaps, leaf_);
  const bool sides_bend = std::ranges::any_of(input.snaps, [](const LeafSnap& s) { return moves(*s.snap); });
  return simple ||
         (loops_are_sound(edges, leaf_) && (!sides_bend || sides_are_sound(edges, sides->outside, leaf_)));
}

}  // namespace quadloop
