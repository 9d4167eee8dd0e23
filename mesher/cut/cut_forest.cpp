#include "mesher/cut/cut_forest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <sstream>

#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/base/parallel/shared_stage.hpp"
#include "mesher/cut/opposed_chords.hpp"
#include "mesher/forest/leaf_finder.hpp"
#include "mesher/sizes/size_cursor.hpp"
#include "mesher/snap/required_snaps.hpp"
#include "mesher/snap/snap_corners.hpp"

namespace quadloop {

namespace {

Point centre_of(const TreeGrid& grid, const Quadrant& q) {
  return grid.corner(q.x + q.size() / 2, q.y + q.size() / 2);
}

/// A smaller angle in a cell is due to rounding: another way to cut the leaf is tried first.
constexpr double thinnest_sine = 1e-11;

/// Even without snapping, vertices as near as this to the boundary move onto it, relative to the local edge:
/// crossings nearer to each other may round to one position.
constexpr double least_snap = 1e-9;

/// Traces the outline and finds the levels of the wanted tree in one traversal.
TracedForest trace_forest(const LeafGraph& graph, SizeTree& sizes, const ShiftedOutline& outline,
                          std::vector<std::int8_t>& target_levels) {
  TracedForest traced(graph.size());
  SizeCursor cursor(sizes);
  target_levels.reserve(graph.local_size());
  for (const LeafId leaf : graph.all()) {
    if (graph.is_local(leaf))
      target_levels.push_back(static_cast<std::int8_t>(cursor.target_level(graph.leaf(leaf))));
    const auto segments = cursor.segments_in(graph.leaf(leaf));
    if (!segments.empty()) traced.add(leaf, outline, sizes.grid().box_of(graph.leaf(leaf)), segments);
  }
  return traced;
}

class ForestCutter {
 public:
  ForestCutter(const LeafGraph& graph, const TreeGrid& grid, const ShiftedOutline& outline,
               const Interior& inside, const TracedForest& traced)
      : graph_{graph},
        grid_{grid},
        outline_{outline},
        inside_{inside},
        traced_{traced},
        cutter_{outline, inside} {
    const std::size_t count = graph.local_size();
    result_.states.resize(count);
    result_.entry_of.assign(count, -1);
    if (has_blocks()) result_.blocks.assign(count, 0);
    reserve();
  }

  /// Cuts all local leaves.
  void cut_all(const std::vector<LeafSnap>& snaps, progress::SharedStage& stage) {
    auto next = snaps.begin();
    for (const LeafId leaf : graph_.local()) {
      stage.advance(graph_.local_index(leaf));
      const auto first = next;
      while (next != snaps.end() && next->leaf == leaf) ++next;
      const std::span<const LeafSnap> own(first, next);
      const bool holds_geometry = trace_of(leaf) >= 0;
      if (!holds_geometry) settle_uncut(leaf);
      if (holds_geometry || !own.empty()) cut(leaf, own);
    }
  }

  /// Cuts the leaves around the corners whose snaps were revoked again.
  void cut_again(const std::vector<LeafSnap>& snaps, const std::vector<GridPoint>& vetoes) {
    std::vector<LeafId> leaves;
    LeafFinder finder(graph_);
    for (const GridPoint corner : vetoes) {
      const auto round = finder.leaves_round(corner);
      leaves.insert(leaves.end(), round.begin(), round.end());
    }
    std::sort(leaves.begin(), leaves.end());
    leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
    for (const LeafId leaf : leaves) {
      if (!graph_.is_local(leaf)) continue;
      const auto [first, last] =
          std::equal_range(snaps.begin(), snaps.end(), LeafSnap{leaf, {}, nullptr},
                           [](const LeafSnap& a, const LeafSnap& b) { return a.leaf < b.leaf; });
      if (trace_of(leaf) < 0 && entry_of(leaf) >= 0) {
        const bool inside = result_.entries[entry_of(leaf)].inside_halves.any();
        state(leaf) = inside ? CutForest::State::inside : CutForest::State::outside;
        entry_of(leaf) = -1;
      }
      cut(leaf, std::span<const LeafSnap>(first, last));
    }
  }

  /// Two opposite chords on the two sides of a leaf side would lose what lies between them, and a chord
  /// between two blocks needs an opposite one: the snaps at their ends are revoked. Returns the ends.
  /// *Collective.*
  std::vector<Point> veto_opposed_chords(const Communicator& comm, const std::vector<const Snap*>& snaps) {
    const OpposedChords opposed(comm, outline_.geometry(), graph_, result_);
    sides_differ_ = opposed.sides_differ();
    const std::vector<Point>& ends = opposed.ends();
    for (const Snap* s : snaps) {
      if (std::ranges::binary_search(ends, s->position)) vetoes_.push_back(s->corner);
    }
    return ends;
  }

  /// Reports chords that lie on each other without any snap, or the two sides of an interface that do not
  /// match.
  [[noreturn]] void refuse(Point end) const {
    if (sides_differ_) {
      throw InputError(fmt::format(
          "the interface near ({}, {}): its two sides cannot be meshed with the same nodes at this size; "
          "reduce spacing.min, or move or remove points there",
          end.x, end.y));
    }
    const auto ends_there = [&](const CutForest::Entry& entry, const CutLeaf::Edge& edge) {
      return result_.nodes[entry.begin.nodes + edge.to].position == end;
    };
    for (const CutForest::Entry& entry : result_.entries) {
      for (const CutLeaf::Edge& edge :
           CutForest::part(result_.outline, entry.begin.outline, entry.end.outline)) {
        if (ends_there(entry, edge)) refuse(edge.segment, edge.segment, end);
      }
    }
    throw Fault("opposite chords that belong to no leaf");
  }

  std::vector<GridPoint> take_vetoes() { return std::exchange(vetoes_, {}); }
  CutForest take_result() { return std::move(result_); }

 private:
  /// Reserves memory that suffices in most cases, to avoid reallocation. Reserved memory that is not filled
  /// costs nothing.
  void reserve() {
    const std::size_t cut_leaves = traced_.traces.size();
    result_.entries.reserve(cut_leaves + cut_leaves / 2);
    result_.nodes.reserve(7 * cut_leaves);
    result_.triangles.reserve(cut_leaves);
    result_.quads.reserve(cut_leaves);
    result_.outline.reserve(2 * cut_leaves);
  }

  bool has_blocks() const { return outline_.geometry().has_blocks(); }
  CutForest::State& state(LeafId leaf) { return result_.states[graph_.local_index(leaf)]; }
  std::int32_t& entry_of(LeafId leaf) { return result_.entry_of[graph_.local_index(leaf)]; }
  std::int32_t trace_of(LeafId leaf) const { return traced_.trace_of[leaf.value()]; }

  void cut(LeafId leaf, std::span<const LeafSnap> snaps) {
    const Quadrant& q = graph_.leaf(leaf);
    const Box box = grid_.box_of(q);
    LeafCutter::Input input{{box, {}, {}, {}}, centre_of(grid_, q), graph_.around(leaf).finer, snaps, {}, 0};
    if (trace_of(leaf) >= 0) {
      input.trace = traced_.traces[trace_of(leaf)];
    } else {
      input.inside = state(leaf) == CutForest::State::inside;
      input.block = has_blocks() ? result_.blocks[graph_.local_index(leaf)] : 0;
    }
    const auto done = [&](Detail detail) {
      return cutter_.cut(input, detail) && maker_.make(q, box, cutter_.result(), cells_) &&
             (detail == Detail::exact || maker_.smallest_sine() > thinnest_sine);
    };
    if (!done(Detail::merged)) {
      if (!snaps.empty()) return veto(snaps);
      if (!done(Detail::full) && !done(Detail::exact)) refuse(input.trace);
    }
    const bool bent = std::any_of(snaps.begin(), snaps.end(), [](const LeafSnap& s) {
      return s.snap->on_edge;
    });  // a node of the neighbour
    if (state(leaf) != CutForest::State::outside || trace_of(leaf) >= 0 || bent) store(leaf);
  }

  /// Revokes the snaps that move a vertex or an edge; if there are none, the others, without which crossings
  /// that differ by rounding become different nodes.
  void veto(std::span<const LeafSnap> snaps) {
    const bool any_moves = std::ranges::any_of(snaps, [](const LeafSnap& s) { return moves(*s.snap); });
    for (const LeafSnap& s : snaps) {
      if (moves(*s.snap) || !any_moves) vetoes_.push_back(s.snap->corner);
    }
  }

  CutForest::Offsets offsets() const {
    return {size32(result_.nodes), size32(result_.triangles), size32(result_.quads), size32(result_.outline)};
  }

  void store(LeafId leaf) {
    const CutLeaf& made = cutter_.result();
    CutForest::Entry entry{offsets(), {}, made.inside_halves};
    result_.nodes.insert(result_.nodes.end(), made.nodes.begin(), made.nodes.end());
    result_.triangles.insert(result_.triangles.end(), cells_.triangles.begin(), cells_.triangles.end());
    result_.quads.insert(result_.quads.end(), cells_.quads.begin(), cells_.quads.end());
    result_.outline.insert(result_.outline.end(), made.outline.begin(), made.outline.end());
    if (has_blocks()) {
      result_.triangle_blocks.insert(result_.triangle_blocks.end(), cells_.triangle_blocks.begin(),
                                     cells_.triangle_blocks.end());
      result_.quad_blocks.insert(result_.quad_blocks.end(), cells_.quad_blocks.begin(),
                                 cells_.quad_blocks.end());
    }
    entry.end = offsets();
    state(leaf) = CutForest::State::cut;
    entry_of(leaf) = size32(result_.entries);
    result_.entries.push_back(entry);
  }

  /// Sets state and block of a leaf without geometry.
  void settle_uncut(LeafId leaf) {
    state(leaf) = lies_inside(leaf) ? CutForest::State::inside : CutForest::State::outside;
    if (!has_blocks() || state(leaf) == CutForest::State::outside) return;
    const LeafGraph::Around& around = graph_.around(leaf);
    for (const LeafId other : {around.west, around.south}) {
      if (!graph_.is_local(other) || other > leaf || state(other) != CutForest::State::inside) continue;
      result_.blocks[graph_.local_index(leaf)] = result_.blocks[graph_.local_index(other)];
      return;
    }
    result_.blocks[graph_.local_index(leaf)] = inside_.block_at(centre_of(grid_, graph_.leaf(leaf)));
  }

  /// State from the left or lower neighbour, which is earlier on the curve; if neither is local, from a count
  /// of crossings.
  bool lies_inside(LeafId leaf) {
    const Quadrant& q = graph_.leaf(leaf);
    const LeafGraph::Around& around = graph_.around(leaf);
    const auto known = [&](LeafId other) {
      return graph_.is_local(other) && other < leaf && (trace_of(other) < 0 || entry_of(other) >= 0);
    };
    if (known(around.west)) {
      const Quadrant& west = graph_.leaf(around.west);
      return side_inside(around.west, Side::right, west.level < q.level && q.y != west.y);
    }
    if (known(around.south)) {
      const Quadrant& south = graph_.leaf(around.south);
      return side_inside(around.south, Side::top, south.level < q.level && q.x == south.x);
    }
    return inside_.contains(centre_of(grid_, q));
  }

  /// Whether a half of a side, counter-clockwise, of a processed leaf lies in the domain.
  bool side_inside(LeafId leaf, Side side, bool second_half) {
    if (state(leaf) != CutForest::State::cut) return state(leaf) == CutForest::State::inside;
    const auto& halves = result_.entries[entry_of(leaf)].inside_halves;
    return (second_half ? halves.second : halves.first).contains(side);
  }

  [[noreturn]] void refuse(const LeafTrace& trace) const {
    refuse(trace.pieces.front().first_segment, trace.pieces.back().first_segment, trace.box.centre());
  }

  [[noreturn]] void refuse(std::int32_t first_segment, std::int32_t last_segment, Point place) const {
    const Geometry& g = outline_.geometry();
    const std::string first = g.boundary(g.boundary_of(first_segment)).name,
                      last = g.boundary(g.boundary_of(last_segment)).name;
    std::ostringstream message;
    message.precision(17);
    message << "boundary " << first << (first == last ? "" : " and boundary " + last) << " near (" << place.x
            << ", " << place.y
            << "): the geometry comes so close to itself that double precision cannot separate the two "
               "sides; move or remove points there";
    throw InputError(message.str());
  }

  const LeafGraph& graph_;
  const TreeGrid& grid_;
  const ShiftedOutline& outline_;
  const Interior& inside_;
  const TracedForest& traced_;
  LeafCutter cutter_;
  LeafCellMaker maker_;
  LeafCells cells_;
  CutForest result_;
  std::vector<GridPoint> vetoes_;
  bool sides_differ_ = false;  ///< of an interface, in the last cut
};

}  // namespace

CutForest cut_forest(const Communicator& comm, const LeafGraph& graph, SizeTree& sizes,
                     const ShiftedOutline& outline, const Interior& inside, double snap,
                     std::optional<MirrorAxis> mirror, std::span<const Point> required) {
  std::vector<std::int8_t> target_levels;
  const TracedForest traced = trace_forest(graph, sizes, outline, target_levels);
  std::vector<Snap> snaps =
      choose_snaps(graph, sizes.grid(), outline.geometry(), traced, std::max(snap, least_snap), mirror);
  std::ranges::move(required_snaps(comm, graph, sizes.grid(), required), std::back_inserter(snaps));
  std::vector<const Snap*> standing;  // snaps that have not been revoked
  standing.reserve(snaps.size());
  for (const Snap& s : snaps) standing.push_back(&s);
  std::vector<LeafSnap> leaf_snaps = snaps_of_leaves(graph, snaps);
  ForestCutter cutter(graph, sizes.grid(), outline, inside, traced);
  progress::SharedStage stage(comm, "cutting", graph.local_size(), "leaves");
  comm.together([&] { cutter.cut_all(leaf_snaps, stage); });
  while (true) {
    const std::vector<Point> opposed_ends = cutter.veto_opposed_chords(comm, standing);
    const std::vector<GridPoint> own = cutter.take_vetoes();
    std::vector<GridPoint> vetoes = comm.all_gather_values(std::span<const GridPoint>(own));
    if (vetoes.empty()) {
      comm.together([&] {
        if (!opposed_ends.empty()) cutter.refuse(opposed_ends.front());
      });
      break;
    }
    std::sort(vetoes.begin(), vetoes.end());
    vetoes.erase(std::unique(vetoes.begin(), vetoes.end()), vetoes.end());
    const auto vetoed = [&](const Snap* s) {
      return std::binary_search(vetoes.begin(), vetoes.end(), s->corner);
    };
    std::erase_if(standing, vetoed);
    std::erase_if(leaf_snaps, [&](const LeafSnap& s) { return vetoed(s.snap); });
    comm.together([&] { cutter.cut_again(leaf_snaps, vetoes); });
  }
  CutForest result = cutter.take_result();
  result.moved.reserve(standing.size());
  result.target_levels = std::move(target_levels);
  for (const Snap* s : standing) {
    if (!s->on_edge && !s->in_leaf) result.moved.push_back({s->corner, s->position});
  }
  return result;
}

bool ResolutionTest::unresolved(const Quadrant& q, std::span<const std::int32_t> segments) {
  traces_.clear();
  const LeafTrace trace = traces_[traces_.add(*outline_, grid_->box_of(q), segments)];
  const bool sound = cutter_.cut({trace, centre_of(*grid_, q), {}, {}, {}, 0}, Detail::merged);
  return !sound || cutter_.result().refined;
}

}  // namespace quadloop
