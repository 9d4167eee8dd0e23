#include <algorithm>
#include <numeric>

#include "mesher/base/ids.hpp"
#include "mesher/cut/cut_leaf.hpp"
#include "mesher/geometry/predicates.hpp"

namespace quadloop {

namespace {

using Edges = std::span<const CutLeaf::Edge>;

Point at(const CutLeaf& leaf, std::int32_t node) { return leaf.nodes[node].position; }

/// How far a ray from `hub` must turn clockwise from the ray to `start` until it meets p: 0 for less than
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

/// The edge that goes on from edge `e` with the same part of the domain to its left: where loops touch, the
/// sharpest turn left.
std::size_t next_edge(Edges edges, const CutLeaf& leaf, const std::vector<char>& used, std::size_t e) {
  std::size_t best = edges.size();
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (used[i] != 0 || edges[i].from != edges[e].to) continue;
    const bool better =
        best == edges.size() || clockwise_before(at(leaf, edges[e].to), at(leaf, edges[e].from),
                                                 at(leaf, edges[i].to), at(leaf, edges[best].to));
    if (better) best = i;
  }
  return best;
}

/// Cuts off each closed part of the walk as a loop of its own.
void split_into_loops(const std::vector<std::int32_t>& walk, CutLeaf& leaf) {
  thread_local std::vector<std::int32_t> open;
  open.clear();
  for (const std::int32_t node : walk) {
    const auto again = std::find(open.begin(), open.end(), node);
    if (again != open.end()) {
      leaf.loop_nodes.insert(leaf.loop_nodes.end(), again, open.end());
      leaf.loop_starts.push_back(size32(leaf.loop_nodes));
      open.erase(again, open.end());
    }
    open.push_back(node);
  }
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
  if (e.to == f.from && e.from == f.to) return true;
  if (e.to == f.from) return folds(b, a, d);
  if (e.from == f.to) return folds(a, b, c);
  if (e.from == f.from) return folds(a, b, d);
  if (e.to == f.to) return folds(b, a, c);
  return segments_meet(a, b, c, d);
}

/// How often the loop goes round the point, which is none of its nodes and not on its edges.
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

/// Every hole lies in one outline, every outline in none or in a hole: the loops around a loop add up to 0
/// for an outline, to 1 for a hole.
bool nesting_is_sound(const CutLeaf& leaf) {
  for (std::size_t i = 0; i < leaf.loop_count(); ++i) {
    int around = 0;
    for (std::size_t j = 0; j < leaf.loop_count(); ++j) {
      if (i == j) continue;
      const auto other = leaf.loop(j);
      const auto apart = std::find_if(leaf.loop(i).begin(), leaf.loop(i).end(), [&](std::int32_t n) {
        return std::find(other.begin(), other.end(), n) == other.end();
      });
      if (apart == leaf.loop(i).end()) return false;
      around += times_round(leaf, other, at(leaf, *apart));
    }
    if (around != (winding_of(leaf, leaf.loop(i)) > 0 ? 0 : 1)) return false;
  }
  return true;
}

/// Whether a chord that ends at a node on the sides leaves it into the leaf, or along a side.
bool starts_inwards(const CutLeaf& leaf, std::int32_t node, std::int32_t towards) {
  const std::int32_t before = (node + leaf.side_nodes - 1) % leaf.side_nodes,
                     after = (node + 1) % leaf.side_nodes;
  if (towards == before || towards == after) return true;
  return clockwise_before(at(leaf, node), at(leaf, before), at(leaf, towards), at(leaf, after));
}

}  // namespace

bool trace_loops(Edges edges, CutLeaf& leaf) {
  thread_local std::vector<char> used;
  thread_local std::vector<std::int32_t> walk;
  used.assign(edges.size(), 0);
  for (std::size_t start = 0; start < edges.size(); ++start) {
    if (used[start] != 0) continue;
    walk.assign(1, edges[start].from);
    std::size_t e = start;
    used[e] = 1;
    while (true) {
      walk.push_back(edges[e].to);
      if (edges[e].to == edges[start].from) {
        const std::size_t next = next_edge(edges, leaf, used, e);
        if (next == edges.size() || !clockwise_before(at(leaf, edges[e].to), at(leaf, edges[e].from),
                                                      at(leaf, edges[next].to), at(leaf, edges[start].to))) {
          break;
        }
      }
      e = next_edge(edges, leaf, used, e);
      if (e == edges.size()) return false;
      used[e] = 1;
    }
    split_into_loops(walk, leaf);
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
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (edges_conflict(leaf, edges[i], edges[j])) return false;
    }
  }
  for (std::size_t i = 0; i < leaf.loop_count(); ++i) {
    if (leaf.loop(i).size() < 3) return false;
  }
  return nesting_is_sound(leaf);
}

bool sides_are_sound(Edges edges, Edges bare_sides, const CutLeaf& leaf) {
  const auto same_line = [](const CutLeaf::Edge& e, const CutLeaf::Edge& f) {
    return (e.from == f.from && e.to == f.to) || (e.from == f.to && e.to == f.from);
  };
  for (std::size_t i = 0; i < bare_sides.size(); ++i) {
    for (const CutLeaf::Edge& e : edges) {
      if (!same_line(bare_sides[i], e) && edges_conflict(leaf, bare_sides[i], e)) return false;
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (edges_conflict(leaf, bare_sides[i], bare_sides[j])) return false;
    }
  }
  thread_local std::vector<std::int32_t> round;
  round.resize(leaf.side_nodes);
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
