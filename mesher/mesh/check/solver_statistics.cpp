#include "mesher/mesh/check/solver_statistics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "mesher/mesh/check/cell_pairs.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop {

namespace {

constexpr double inexact = 0.002;

template <class Nodes>
double area_of(const HaloMesh& mesh, const Nodes& nodes) {
  const Point a = mesh.point(nodes[0]), b = mesh.point(nodes[1]), c = mesh.point(nodes[2]);
  if constexpr (std::tuple_size_v<Nodes> == 3) return 0.5 * cross(b - a, c - a);
  return 0.5 * cross(c - a, mesh.point(nodes.back()) - b);
}

/// Rotates by 90 degrees clockwise.
Point turned(Point v) { return {v.y, -v.x}; }

/// Sums over the edges of a node's dual cell; positions are relative to the node.
struct DualSum {
  double area = 0;
  Point with_x, with_y;  ///< columns of the sum of (midpoint) x (face)

  void add_face(Point middle, Point face) {
    with_x = with_x + middle.x * face;
    with_y = with_y + middle.y * face;
  }
  bool is_exact() const {
    const double most = inexact * area;
    return std::abs(with_x.x - area) <= most && std::abs(with_x.y) <= most && std::abs(with_y.x) <= most &&
           std::abs(with_y.y - area) <= most;
  }
};

/// The part of a cell around its k-th node is bounded by the midpoints of its two edges there and the mean of
/// the cell's nodes.
template <class Nodes>
void add_corner(const HaloMesh& mesh, const Nodes& nodes, std::size_t k, DualSum& sum) {
  const std::size_t n = nodes.size();
  const Point p = mesh.point(nodes[k]);
  Point centre;
  const double weight = 1.0 / size32(nodes);
  for (const NodeId node : nodes) centre = centre + weight * (mesh.point(node) - p);
  const Point after = 0.5 * (mesh.point(nodes[(k + 1) % n]) - p),
              before = 0.5 * (mesh.point(nodes[(k + n - 1) % n]) - p);
  sum.add_face(after, turned(centre - after));
  sum.add_face(before, turned(before - centre));
  sum.area += 0.5 * cross(centre, before - after);
}

/// Flags the boundary nodes of the halo mesh, correctly for all its nodes. *Collective.*
NodeFlags boundary_nodes(const HaloMesh& mesh) {
  NodeFlags flags(mesh.points().size(), 0);
  for (const HaloEdge& edge : mesh.boundary_edges()) {
    for (const NodeId node : {edge.from, edge.to}) flags[node] = 1;
  }
  mesh.exchange().update(flags);
  return flags;
}

/// The largest and the smallest area of the cells around a node.
struct AreaRange {
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;
  double ratio() const { return area_ratio(largest, smallest); }
};
using AreaRanges = IdVector<NodeId, AreaRange>;

/// Returns the ranges at the owned nodes.
AreaRanges areas_round_nodes(const HaloMesh& mesh) {
  AreaRanges ranges(mesh.owned_nodes());
  mesh.for_each_cell([&](const auto& nodes) {
    const double area = area_of(mesh, nodes);
    for (const NodeId node : nodes) {
      if (!mesh.owns(node)) continue;
      AreaRange& range = ranges[node];
      range = {std::min(range.smallest, area), std::max(range.largest, area)};
    }
  });
  return ranges;
}

enum Ring : std::int32_t { triangles = 1, parallelograms = 2, others = 4 };

/// Returns the kind of a cell of positive area for the rings of its nodes. Parallelograms are exact at each
/// corner, triangles only together. The accepted skew is far below what makes a node inexact, even for very
/// long cells.
template <class Nodes>
std::int32_t kind_of(const HaloMesh& mesh, const Nodes& nodes) {
  constexpr double least_skew = 1e-7;
  if constexpr (std::tuple_size_v<Nodes> == 3) return Ring::triangles;
  const Point gap =
      mesh.point(nodes[0]) - mesh.point(nodes[1]) + mesh.point(nodes[2]) - mesh.point(nodes.back());
  return dot(gap, gap) <= least_skew * least_skew * area_of(mesh, nodes) ? Ring::parallelograms
                                                                         : Ring::others;
}

/// Numbers the few inner nodes that need a check: their ring has mixed cells or other quads, all with
/// positive area. -1 for all other nodes.
IdVector<NodeId, std::int32_t> places_of_doubtful_nodes(const HaloMesh& mesh, const NodeFlags& on_boundary,
                                                        const AreaRanges& areas) {
  IdVector<NodeId, std::int32_t> places(mesh.owned_nodes(), 0);
  if (mesh.has_quads()) {
    mesh.for_each_cell([&](const auto& nodes) {
      const std::int32_t kind = kind_of(mesh, nodes);
      for (const NodeId node : nodes) {
        if (mesh.owns(node)) places[node] |= kind;
      }
    });
  }
  std::int32_t count = 0;
  for (const NodeId node : places.ids()) {
    const bool plain = places[node] <= Ring::parallelograms && areas[node].smallest > 0;
    places[node] = plain || on_boundary[node] != 0 ? -1 : count++;
  }
  return places;
}

/// Returns the number on this rank.
std::int64_t count_inexact_nodes(const HaloMesh& mesh, const NodeFlags& on_boundary,
                                 const AreaRanges& areas) {
  const IdVector<NodeId, std::int32_t> places = places_of_doubtful_nodes(mesh, on_boundary, areas);
  std::vector<DualSum> sums(std::ranges::count_if(places, [](std::int32_t place) { return place >= 0; }));
  if (sums.empty()) return 0;
  mesh.for_each_cell([&](const auto& nodes) {
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (mesh.owns(nodes[k]) && places[nodes[k]] >= 0) add_corner(mesh, nodes, k, sums[places[nodes[k]]]);
    }
  });
  return std::ranges::count_if(sums, [](const DualSum& sum) { return !sum.is_exact(); });
}

void count_parallelograms(const Mesh& mesh, SolverStatistics& statistics) {
  for (const auto& q : mesh.quads) {
    const bool parallel =
        skew_of({mesh.point(q[0]), mesh.point(q[1]), mesh.point(q[2]), mesh.point(q[3])}) <= parallel_skew;
    statistics.parallelograms += parallel ? 1 : 0;
  }
  statistics.quads = std::ssize(mesh.quads);
}

/// Returns the largest ratio at edges between nodes whose ranges have a ratio of `least` or more, over this
/// rank's owned nodes.
double largest_ratio(const HaloMesh& mesh, const AreaRanges& ranges, double least) {
  double largest = 0;
  CellPairs<double> pairs(mesh, [&](NodeId node) { return ranges[node].ratio() >= least; });
  pairs.for_each([&](const auto& nodes, std::int32_t) { return area_of(mesh, nodes); },
                 [&](NodeId, NodeId, double area, double other) {
                   largest = std::max(largest, area_ratio(area, other));
                 });
  return largest;
}

/// The ratio at an edge is at most that of all cells around either node: so only nodes of large ratios are
/// visited, until an edge among them reaches the bound. *Collective.*
double largest_area_ratio(const Communicator& comm, const HaloMesh& mesh, const AreaRanges& ranges) {
  double bound = 1;
  for (const AreaRange& range : ranges) bound = std::max(bound, range.largest > 0 ? range.ratio() : 1);
  bound = comm.maximum(bound);
  if (!std::isfinite(bound)) return comm.maximum(largest_ratio(mesh, ranges, 1));
  for (;;) {
    bound = std::max(1.0, bound / 2);
    const double found = comm.maximum(largest_ratio(mesh, ranges, bound));
    if (found >= bound || bound == 1) return found;
  }
}

/// Neighbours of a node along boundary edges, by global number; four are enough to detect passages.
struct BoundaryNeighbours {
  std::array<GlobalNodeId, 4> nodes;
  void add(GlobalNodeId node) {
    const auto place = std::find(nodes.begin(), nodes.end(), GlobalNodeId{});
    if (place != nodes.end()) *place = node;
  }
  bool holds(GlobalNodeId node) const { return std::find(nodes.begin(), nodes.end(), node) != nodes.end(); }
};

/// Boundary neighbours of the boundary nodes, which are few.
class BoundaryRing {
 public:
  /// *Collective.*
  BoundaryRing(const HaloMesh& mesh, const NodeFlags& on_boundary) {
    for (const NodeId node : on_boundary.ids()) {
      if (on_boundary[node] != 0) nodes_.push_back(node);
    }
    neighbours_.resize(nodes_.size());
    for (const auto& [from, to, boundary] : mesh.boundary_edges()) {
      if (mesh.owns(from)) of(from).add(mesh.global(to));
      if (mesh.owns(to)) of(to).add(mesh.global(from));
    }
    mesh.exchange().update_some(
        [&](std::int32_t node) {
          return on_boundary[NodeId{node}] != 0 ? of(NodeId{node}) : BoundaryNeighbours{};
        },
        [&](std::int32_t node, const BoundaryNeighbours& known) {
          if (on_boundary[NodeId{node}] != 0) of(NodeId{node}) = known;
        });
  }

  BoundaryNeighbours& of(NodeId node) {
    return neighbours_[std::ranges::lower_bound(nodes_, node) - nodes_.begin()];
  }

 private:
  std::vector<NodeId> nodes_;  ///< sorted
  std::vector<BoundaryNeighbours> neighbours_;
};

/// Counts passage cells; each is counted by the owner of its first node. *Collective.*
std::int64_t count_passage_cells(const HaloMesh& mesh, const NodeFlags& on_boundary) {
  BoundaryRing ring(mesh, on_boundary);
  const auto is_boundary = [&](NodeId a, NodeId b) { return ring.of(a).holds(mesh.global(b)); };
  std::int64_t count = 0;
  mesh.for_each_cell([&](const auto& nodes) {
    const std::size_t n = nodes.size();
    if (!mesh.owns(nodes[0])) return;
    for (const NodeId node : nodes) {
      if (on_boundary[node] == 0) return;
    }
    for (std::size_t k = 0; k < n; ++k) {
      if (is_boundary(nodes[k], nodes[(k + 1) % n]) && is_boundary(nodes[(k + 1) % n], nodes[(k + 2) % n]))
        return;
    }
    ++count;
  });
  return count;
}

}  // namespace

SolverStatistics solver_statistics(const Communicator& comm, const Mesh& mesh) {
  SolverStatistics statistics;
  const HaloMesh halo(comm, mesh);
  const NodeFlags on_boundary = boundary_nodes(halo);
  count_parallelograms(mesh, statistics);
  const AreaRanges areas = areas_round_nodes(halo);
  statistics.quads = comm.sum(statistics.quads);
  statistics.parallelograms = comm.sum(statistics.parallelograms);
  statistics.inner_nodes =
      comm.sum(std::count(on_boundary.begin(), on_boundary.begin() + mesh.owned_nodes, 0));
  statistics.inexact_nodes = comm.sum(count_inexact_nodes(halo, on_boundary, areas));
  statistics.area_ratio_max = largest_area_ratio(comm, halo, areas);
  statistics.passage_cells = comm.sum(count_passage_cells(halo, on_boundary));
  return statistics;
}

}  // namespace quadloop
