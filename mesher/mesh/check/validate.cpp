#include "mesher/mesh/check/validate.hpp"

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "mesher/base/ids.hpp"
#include "mesher/geometry/point_table.hpp"
#include "mesher/geometry/predicates.hpp"
#include "mesher/mesh/check/validate_rules.hpp"
#include "mesher/mesh/paired_nodes.hpp"

namespace quadloop {

namespace {

template <class Visit>
void for_each_cell(const Mesh& mesh, const Visit& visit) {
  mesh.for_each_cell([&](const auto& nodes) { visit(std::span<const NodeId>(nodes)); });
}

template <class Visit>
void for_each_boundary_edge(const Mesh& mesh, const Visit& visit) {
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (const auto& edge : boundary.edges) visit(boundary, edge);
  }
}

/// Both exactly and in the rounded arithmetic of a solver.
bool turns_left(Point a, Point b, Point c) { return cross(b - a, c - a) > 0 && orientation(a, b, c) > 0; }

/// Returns a node that a cell has twice, if any.
NodeId repeated_node(std::span<const NodeId> cell) {
  for (std::size_t k = 1; k < cell.size(); ++k) {
    const auto before = cell.first(k);
    if (std::find(before.begin(), before.end(), cell[k]) != before.end()) return cell[k];
  }
  return {};
}

bool is_unused_node(const MeshFault& fault) {
  return fault.what.find("belongs to no cell") != std::string::npos;
}

/// Whether the errors of check_indices make the later rules meaningless.
bool senseless(const Faults& faults) { return !std::all_of(faults.begin(), faults.end(), is_unused_node); }

struct ConformingFaults {
  const Mesh& mesh;
  Faults& faults;
  void add(const std::string& what, NodeId node) const {
    faults.push_back({MeshRule::conforming, what, mesh.point(node)});
  }
};

using BoundaryEdge = std::array<NodeId, 2>;

/// Flags the ends of boundary edges that coincide with one in the opposite direction.
NodeFlags nodes_at_cracks(const Mesh& mesh) {
  using Ends = std::pair<Point, Point>;
  std::vector<Ends> edges;
  for_each_boundary_edge(mesh, [&](const BoundaryEdges&, const BoundaryEdge& edge) {
    edges.emplace_back(mesh.point(edge[0]), mesh.point(edge[1]));
  });
  std::sort(edges.begin(), edges.end());
  NodeFlags flags(mesh.points.size(), 0);
  for_each_boundary_edge(mesh, [&](const BoundaryEdges&, const BoundaryEdge& edge) {
    const Ends opposite{mesh.point(edge[1]), mesh.point(edge[0])};
    if (std::binary_search(edges.begin(), edges.end(), opposite)) flags[edge[0]] = flags[edge[1]] = 1;
  });
  return flags;
}

/// Returns the boundaries' edges, sorted.
std::vector<BoundaryEdge> check_boundary_edges(const Mesh& mesh, const CellBlocks& blocks,
                                               const EdgeTable& table, const ConformingFaults& faults) {
  std::vector<BoundaryEdge> bounded;
  for_each_boundary_edge(mesh, [&](const BoundaryEdges& boundary, const BoundaryEdge& edge) {
    bounded.push_back(edge);
    const std::int32_t left = table.cell_left_of(edge[0], edge[1]),
                       right = table.cell_left_of(edge[1], edge[0]);
    if (left < 0) faults.add("an edge of boundary " + boundary.name + " has no cell to its left", edge[0]);
    if (left < 0 || right < 0 || boundary.inner_line) return;
    if (blocks.of(left) == blocks.of(right))
      faults.add("an edge of boundary " + boundary.name + " has cells of one block on both sides", edge[0]);
  });
  std::sort(bounded.begin(), bounded.end());
  return bounded;
}

}  // namespace

const char* name_of(MeshRule rule) {
  switch (rule) {
    case MeshRule::indices: return "indices";
    case MeshRule::coincident: return "coincident";
    case MeshRule::positive: return "positive";
    case MeshRule::conforming: return "conforming";
    case MeshRule::closed: return "closed";
    case MeshRule::area: return "area";
    case MeshRule::overlap: return "overlap";
    case MeshRule::pairs: return "pairs";
    case MeshRule::geometry: return "geometry";
  }
  return "unknown";
}

void check_indices(const Mesh& mesh, Faults& faults) {
  for (const Point p : mesh.points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y))
      faults.push_back({MeshRule::indices, "a coordinate is not finite", p});
  }
  NodeFlags used(mesh.points.size(), 0);
  const auto exists = [&](NodeId node) {
    if (node.valid() && node.value() < std::ssize(used)) return true;
    faults.push_back(
        {MeshRule::indices, "node " + std::to_string(node.value() + 1) + " is named but does not exist", {}});
    return false;
  };
  for_each_cell(mesh, [&](std::span<const NodeId> cell) {
    for (const NodeId node : cell) {
      if (exists(node)) used[node] = 1;
    }
  });
  for_each_boundary_edge(mesh, [&](const BoundaryEdges&, const std::array<NodeId, 2>& edge) {
    exists(edge[0]);
    exists(edge[1]);
  });
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    if (boundary.edges.empty())
      faults.push_back({MeshRule::indices, "boundary " + boundary.name + " has no edges", {}});
  }
  for (const NodeId node : used.ids()) {
    if (used[node] == 0)
      faults.push_back({MeshRule::indices, "node " + std::to_string(node.value() + 1) + " belongs to no cell",
                        mesh.point(node)});
  }
  if (mesh.triangles.empty() && mesh.quads.empty())
    faults.push_back({MeshRule::indices, "there are no cells", {}});
}

void check_coincident(const Mesh& mesh, Faults& faults) {
  if (!PointTable(mesh.points).any_twice()) return;
  const NodeFlags at_crack = nodes_at_cracks(mesh);
  std::vector<std::int32_t> order(mesh.points.size());
  std::iota(order.begin(), order.end(), 0);
  const auto at = [&](std::int32_t i) { return mesh.points[i]; };
  std::sort(order.begin(), order.end(), [&](std::int32_t i, std::int32_t j) { return at(i) < at(j); });
  for (std::size_t k = 1; k < order.size(); ++k) {
    if (at(order[k]) != at(order[k - 1])) continue;
    if (at_crack[NodeId{order[k]}] != 0 && at_crack[NodeId{order[k - 1]}] != 0) continue;
    faults.push_back(
        {MeshRule::coincident,
         "nodes " + std::to_string(order[k - 1] + 1) + " and " + std::to_string(order[k] + 1) + " coincide",
         at(order[k])});
  }
}

void check_positive(const Mesh& mesh, Faults& faults) {
  for_each_cell(mesh, [&](std::span<const NodeId> cell) {
    const std::size_t width = cell.size();
    for (std::size_t k = 0; k < width; ++k) {
      const Point p = mesh.point(cell[k]);
      if (turns_left(p, mesh.point(cell[(k + 1) % width]), mesh.point(cell[(k + width - 1) % width])))
        continue;
      faults.push_back({MeshRule::positive,
                        std::string("a ") + (width == 3 ? "triangle" : "quad") + " is inverted or flat", p});
      return;
    }
  });
}

void check_conforming(const Mesh& mesh, const CellBlocks& blocks, const MeshTopology& topology,
                      Faults& all_faults) {
  const ConformingFaults faults{mesh, all_faults};
  for_each_cell(mesh, [&](std::span<const NodeId> cell) {
    const NodeId node = repeated_node(cell);
    if (node.valid()) faults.add("a cell has node " + std::to_string(node.value() + 1) + " twice", node);
  });
  const EdgeTable& table = topology.table();
  const std::vector<BoundaryEdge> bounded = check_boundary_edges(mesh, blocks, table, faults);
  const bool repeats = table.repeats();
  auto outer = topology.outer_edges().begin();
  const auto end = topology.outer_edges().end();
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t cell) {
    const bool first = !repeats || table.cell_left_of(from, to) == cell;
    const bool alone = first && outer != end && outer->from == from && outer->to == to;
    if (alone) ++outer;
    if (!first) faults.add("an edge belongs to two cells in the same direction", from);
    if (!first || !alone || std::binary_search(bounded.begin(), bounded.end(), BoundaryEdge{from, to}))
      return;
    faults.add("an edge has one cell and no boundary edge (a crack, a hanging node or a missing boundary)",
               from);
  });
}

void check_closed(const Mesh& mesh, const MeshTopology& topology, Faults& faults) {
  std::vector<std::array<NodeId, 2>> all;
  for_each_boundary_edge(
      mesh, [&](const BoundaryEdges&, const std::array<NodeId, 2>& edge) { all.push_back(edge); });
  std::sort(all.begin(), all.end());
  for (std::size_t k = 1; k < all.size(); ++k) {
    if (all[k] == all[k - 1])
      faults.push_back({MeshRule::closed, "a boundary edge is listed twice", mesh.point(all[k][0])});
  }
  IdVector<NodeId, std::int32_t> out_minus_in(mesh.points.size(), 0);
  for (const auto& edge : topology.outer_edges()) {
    ++out_minus_in[edge.from];
    --out_minus_in[edge.to];
  }
  for (const NodeId node : out_minus_in.ids()) {
    if (out_minus_in[node] != 0)
      faults.push_back({MeshRule::closed, "the boundary does not close", mesh.point(node)});
  }
}

std::vector<MeshFault> validate(const Mesh& mesh, const CellBlocks& blocks) {
  Faults faults;
  check_indices(mesh, faults);
  if (senseless(faults)) return faults;
  check_coincident(mesh, faults);
  check_positive(mesh, faults);
  const MeshTopology topology(mesh, MeshTopology::Kept::outer_edges);
  check_conforming(mesh, blocks, topology, faults);
  check_closed(mesh, topology, faults);
  check_area(mesh, topology, faults);
  check_overlap(mesh, topology, faults);
  for (const PeriodicPair& pair : mesh.pairs) {
    if (const auto fault = fault_of_pair(Communicator(MPI_COMM_SELF), mesh, pair))
      faults.push_back({MeshRule::pairs, fault->what, fault->place});
  }
  return faults;
}

std::vector<MeshFault> validate_topology(const Mesh& mesh, const CellBlocks& blocks) {
  Faults faults;
  check_indices(mesh, faults);
  if (senseless(faults)) return faults;
  const MeshTopology topology(mesh, MeshTopology::Kept::outer_edges);
  check_conforming(mesh, blocks, topology, faults);
  check_closed(mesh, topology, faults);
  return faults;
}

}  // namespace quadloop
