#include <algorithm>
#include <numeric>
#include <utility>

#include "mesher/base/ids.hpp"
#include "mesher/base/short_lists.hpp"
#include "mesher/cut/cut_leaf.hpp"
#include "mesher/geometry/box_tree.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

using Edges = std::span<const CutLeaf::Edge>;

Point at(const CutLeaf& leaf, std::int32_t node) { return leaf.nodes[node].position; }

/// Returns how far a ray from `hub` turns clockwise from the ray to `start` until it meets p: 0 for less than
/// half a turn, 1 for half, 2 for more.
int clockwise_half(Point hub, Point start, Point p) {
  const int side = orientation(hub, start, p);
  if (side != 0) return side < 0 ? 0 : 2;
  return dot(start - hub, p - hub) < 0 ? 1 : 2;
}

/// Whether the ray from `hub` to a comes before the one to b, turning clockwise from the ray to `start`.
bool clockwise_before(Point hub, Point start, Point a, Point b) {
  const int half_a = clockwise_half(hub, start, a), half_b = clockwise_half(hub, start, b);
  return half_a != half_b ? half_a < half_b : orientation(hub, a, b) < 0;
}

/// The edges that are not in a loop yet, by their start nodes.
class UnusedEdges {
 public:
  UnusedEdges(Edges edges, const CutLeaf& leaf, std::pmr::memory_resource* memory)
      : edges_{edges},
        leaf_{leaf},
        used_(edges.size(), 0, memory),
        by_start_(edges.size(), memory),
        end_of_(leaf.nodes.size() + 1, 0, memory) {
    for (const CutLeaf::Edge& e : edges) ++end_of_[e.from + 1];
    std::partial_sum(end_of_.begin(), end_of_.end(), end_of_.begin());
    for (std::int32_t e = 0; e < size32(edges); ++e) by_start_[end_of_[edges[e].from]++] = e;
  }

  bool has(std::size_t e) const { return used_[e] == 0; }
  void take(std::size_t e) { used_[e] = 1; }

  /// Returns the edge that continues edge `e` with the same part of its block on the left: where loops
  /// touch, the sharpest left turn. Returns the number of edges if there is none.
  std::size_t next(std::size_t e) const {
    std::size_t best = edges_.size();
    const std::int32_t node = edges_[e].to;
    for (std::int32_t k = node > 0 ? end_of_[node - 1] : 0; k < end_of_[node]; ++k) {
      const std::int32_t i = by_start_[k];
      const bool better =
          has(i) && edges_[i].block == edges_[e].block &&
          (best == edges_.size() || clockwise_before(at(leaf_, edges_[e].to), at(leaf_, edges_[e].from),
                                                     at(leaf_, edges_[i].to), at(leaf_, edges_[best].to)));
      if (better) best = i;
    }
    return best;
  }

 private:
  Edges edges_;
  const CutLeaf& leaf_;
  std::pmr::vector<char> used_;
  std::pmr::vector<std::int32_t> by_start_;
  std::pmr::vector<std::int32_t> end_of_;  ///< end of each node's edges in by_start_
};

/// Splits off each closed part of the walk through one block as a separate loop. Uses two work lists: `open`,
/// and `place_in_open`, which is -1 for all nodes before and after.
void split_into_loops(std::span<const std::int32_t> walk, std::int32_t block,
                      std::pmr::vector<std::int32_t>& open, std::pmr::vector<std::int32_t>& place_in_open,
                      CutLeaf& leaf) {
  open.clear();
  const auto forget = [&](std::int32_t node) { place_in_open[node] = -1; };
  for (const std::int32_t node : walk) {
    if (place_in_open[node] >= 0) {
      const auto again = open.begin() + place_in_open[node];
      leaf.loop_nodes.insert(leaf.loop_nodes.end(), again, open.end());
      leaf.loop_starts.push_back(size32(leaf.loop_nodes));
      leaf.loop_blocks.push_back(block);
      std::for_each(again, open.end(), forget);
      open.erase(again, open.end());
    }
    place_in_open[node] = size32(open);
    open.push_back(node);
  }
  std::ranges::for_each(open, forget);
}

bool edges_conflict(const CutLeaf& leaf, const CutLeaf::Edge& e, const CutLeaf::Edge& f) {
  const Point a = at(leaf, e.from), b = at(leaf, e.to), c = at(leaf, f.from), d = at(leaf, f.to);
  if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x) ||
      std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y)) {
    return false;
  }
  const auto folds = [](Point hub, Point p, Point q) {
    return dot(p - hub, q - hub) > 0 && orientation(hub, p, q) == 0;
  };
  if (e.to == f.from && e.from == f.to)  // two chords of an inner line, or of two blocks
    return e.block == f.block && (e.segment < 0 || f.segment < 0);
  if (e.to == f.from) return folds(b, a, d);
  if (e.from == f.to) return folds(a, b, c);
  if (e.from == f.from) return folds(a, b, d);
  if (e.to == f.to) return folds(b, a, c);
  return segments_meet(a, b, c, d);
}

/// Finds conflicts of an edge with others.
class EdgeIndex {
 public:
  EdgeIndex(const CutLeaf& leaf, Edges edges) : leaf_{leaf}, edges_{edges} {
    constexpr std::size_t few_edges = 32;  // up to this number testing all pairs is faster than a tree
    if (edges.size() > few_edges)
      tree_ = BoxTree(size32(edges), [&](std::int32_t e) { return box(edges[e]); });
  }

  /// Whether the edge conflicts with any of the first `end` edges for which `counts(number)` is true.
  template <class Counts>
  bool any_conflict(const CutLeaf::Edge& edge, std::int32_t end, const Counts& counts) const {
    const auto conflicts = [&](std::int32_t e) {
      return counts(e) && edges_conflict(leaf_, edge, edges_[e]);
    };
    if (!tree_.empty())
      return tree_.any_meeting(box(edge), [&](std::int32_t e) { return e < end && conflicts(e); });
    for (std::int32_t e = 0; e < end; ++e) {
      if (conflicts(e)) return true;
    }
    return false;
  }

 private:
  Box box(const CutLeaf::Edge& e) const { return box_of(at(leaf_, e.from), at(leaf_, e.to)); }

  const CutLeaf& leaf_;
  Edges edges_;
  BoxTree tree_;
};

/// Whether any two of the edges conflict.
bool any_conflict(const CutLeaf& leaf, Edges edges) {
  const EdgeIndex index(leaf, edges);
  for (std::int32_t i = 0; i < size32(edges); ++i) {
    if (index.any_conflict(edges[i], i, [](std::int32_t) { return true; })) return true;
  }
  return false;
}

/// Returns the winding number of the loop around the point, which must not be a node or on an edge of it.
int times_round(const CutLeaf& leaf, std::span<const std::int32_t> loop, Point p) {
  int times = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Point a = at(leaf, loop[i]), b = at(leaf, loop[(i + 1) % loop.size()]);
    const bool up = b.y > p.y;
    if (up == (a.y > p.y)) continue;
    const bool left = orientation(a, b, p) > 0;
    if (up && left) ++times;
    if (!up && !left) --times;
  }
  return times;
}

/// Returns the winding number of the loop around the start of the edge from its node `corner` towards the
/// point, which must not be on an edge of it.
int times_round_start(const CutLeaf& leaf, std::span<const std::int32_t> loop, std::int32_t corner,
                      Point towards) {
  const std::size_t k = std::ranges::find(loop, corner) - loop.begin();
  const std::int32_t before = loop[(k + loop.size() - 1) % loop.size()], after = loop[(k + 1) % loop.size()];
  const bool left = clockwise_before(at(leaf, corner), at(leaf, before), towards, at(leaf, after));
  if (winding_of(leaf, loop) > 0) return left ? 1 : 0;
  return left ? 0 : -1;
}

/// Returns the winding number of one loop around another that it does not cross. If loops touch, all nodes of
/// one may be nodes of the other.
int times_round(const CutLeaf& leaf, std::span<const std::int32_t> around,
                std::span<const std::int32_t> loop) {
  const auto apart = std::ranges::find_if(
      loop, [&](std::int32_t n) { return std::ranges::find(around, n) == around.end(); });
  if (apart != loop.end()) return times_round(leaf, around, at(leaf, *apart));
  return times_round_start(leaf, around, loop[0], at(leaf, loop[1]));
}

/// Every hole must lie in one outer loop of its block, every outer loop in none or in a hole: the winding
/// numbers of the block's loops around a loop sum to 0 for an outer loop, to 1 for a hole.
bool nesting_is_sound(const CutLeaf& leaf) {
  if (leaf.loop_count() == 1) return winding_of(leaf, leaf.loop(0)) > 0;
  const auto box_of_loop = [&](std::int32_t i) {
    Box box;
    for (const std::int32_t n : leaf.loop(i)) box.include(at(leaf, n));
    return box;
  };
  const auto count = static_cast<std::int32_t>(leaf.loop_count());
  const BoxTree boxes(count, box_of_loop);
  for (std::int32_t i = 0; i < count; ++i) {
    const auto loop = leaf.loop(i);
    int around = 0;
    boxes.for_each_meeting(box_of_loop(i), [&](std::int32_t j) {
      if (i != j && leaf.loop_blocks[i] == leaf.loop_blocks[j])
        around += times_round(leaf, leaf.loop(j), loop);
    });
    if (around != (winding_of(leaf, loop) > 0 ? 0 : 1)) return false;
  }
  return true;
}

/// Whether a node lies on no edge, not even at its ends.
bool stands_alone(const CutLeaf& leaf, Edges edges, std::int32_t node) {
  return std::ranges::none_of(edges, [&](const CutLeaf::Edge& e) {
    return on_segment(at(leaf, node), at(leaf, e.from), at(leaf, e.to));
  });
}

/// Whether a chord that ends at a node on the sides points into the leaf, or along a side.
bool starts_inwards(const CutLeaf& leaf, std::int32_t node, std::int32_t towards) {
  const std::int32_t before = (node + leaf.side_nodes - 1) % leaf.side_nodes,
                     after = (node + 1) % leaf.side_nodes;
  if (towards == before || towards == after) return true;
  return clockwise_before(at(leaf, node), at(leaf, before), at(leaf, towards), at(leaf, after));
}

}  // namespace

bool trace_loops(Edges edges, CutLeaf& leaf) {
  ShortLists<1024> lists;
  std::pmr::vector<std::int32_t> walk(lists.memory()), open(lists.memory()),
      place_in_open(leaf.nodes.size(), -1, lists.memory());
  walk.reserve(edges.size() + 1);
  open.reserve(edges.size() + 1);
  UnusedEdges unused(edges, leaf, lists.memory());
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (!unused.has(start)) continue;
    walk.assign(1, edges[start].from);
    std::size_t e = start;
    unused.take(e);
    while (true) {
      walk.push_back(edges[e].to);
      if (edges[e].to == edges[start].from) {
        const std::size_t next = unused.next(e);
        if (next == edges.size() || !clockwise_before(at(leaf, edges[e].to), at(leaf, edges[e].from),
                                                      at(leaf, edges[next].to), at(leaf, edges[start].to))) {
          break;
        }
      }
      e = unused.next(e);
      if (e == edges.size()) return false;
      unused.take(e);
    }
    split_into_loops(walk, edges[start].block, open, place_in_open, leaf);
  }
  return true;
}

int winding_of(const CutLeaf& leaf, std::span<const std::int32_t> loop) {
  const auto lowest = std::min_element(loop.begin(), loop.end(), [&](std::int32_t a, std::int32_t b) {
    const Point &p = leaf.nodes[a].position, &q = leaf.nodes[b].position;
    return p.x != q.x ? p.x < q.x : p.y < q.y;
  });
  const std::int32_t before = lowest == loop.begin() ? loop.back() : lowest[-1];
  const std::int32_t after = lowest + 1 == loop.end() ? loop.front() : lowest[1];
  return orientation(at(leaf, before), at(leaf, *lowest), at(leaf, after));
}

bool loops_are_sound(Edges edges, const CutLeaf& leaf) {
  if (any_conflict(leaf, edges)) return false;
  for (std::size_t i = 0; i < leaf.loop_count(); ++i) {
    const auto loop = leaf.loop(i);
    if (loop.size() < 2 && !stands_alone(leaf, edges, loop[0])) return false;
  }
  return nesting_is_sound(leaf);
}

bool sides_are_sound(Edges edges, Edges bare_sides, const CutLeaf& leaf) {
  const auto same_line = [](const CutLeaf::Edge& e, const CutLeaf::Edge& f) {
    return (e.from == f.from && e.to == f.to) || (e.from == f.to && e.to == f.from);
  };
  const EdgeIndex index(leaf, edges);
  for (const CutLeaf::Edge& bare : bare_sides) {
    const auto counts = [&](std::int32_t e) { return !same_line(bare, edges[e]); };
    if (index.any_conflict(bare, size32(edges), counts)) return false;
  }
  if (any_conflict(leaf, bare_sides)) return false;
  ShortLists<256> lists;
  std::pmr::vector<std::int32_t> round(leaf.side_nodes, lists.memory());
  std::iota(round.begin(), round.end(), 0);
  for (const CutLeaf::Edge& e : leaf.outline) {
    if (e.from < leaf.side_nodes && !starts_inwards(leaf, e.from, e.to)) return false;
    if (e.to < leaf.side_nodes && !starts_inwards(leaf, e.to, e.from)) return false;
  }
  for (std::size_t n = leaf.side_nodes; n < leaf.nodes.size(); ++n) {
    if (times_round(leaf, round, leaf.nodes[n].position) != 1) return false;
  }
  return winding_of(leaf, round) > 0;
}

}  // namespace quadloop
