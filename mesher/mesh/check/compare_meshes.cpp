#include "mesher/mesh/check/compare_meshes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "mesher/base/parallel/exchange.hpp"
#include "mesher/mesh/node_exchange.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

namespace {

template <std::size_t width>
using Cells = std::vector<std::array<NodeId, width>>;

/// Sorts the nodes of each cell, then the cells, so that equal cells give equal lists.
template <std::size_t width>
Cells<width> in_one_order(Cells<width> cells) {
  for (auto& nodes : cells) std::ranges::sort(nodes);
  std::ranges::sort(cells);
  return cells;
}

template <std::size_t width>
std::optional<std::array<NodeId, width>> first_other(const Cells<width>& found, const Cells<width>& wanted) {
  const Cells<width> one = in_one_order(found), other = in_one_order(wanted);
  const auto [at, unlike] = std::ranges::mismatch(one, other);
  return at == one.end() ? std::nullopt : std::optional(*at);
}

/// Returns the square of the shortest edge at each node.
IdVector<NodeId, double> shortest_edges(const Mesh& mesh) {
  IdVector<NodeId, double> shortest(mesh.points.size(), std::numeric_limits<double>::infinity());
  for_each_cell_edge(mesh, [&](NodeId from, NodeId to, std::int32_t) {
    const Point along = mesh.point(to) - mesh.point(from);
    for (const NodeId node : {from, to}) {
      double& least = shortest[node];
      least = std::min(least, dot(along, along));
    }
  });
  return shortest;
}

/// Returns the difference; empty if the cells are the same, in any order.
template <std::size_t width>
std::string cell_difference(const std::string& kind, const std::vector<std::array<NodeId, width>>& found,
                            const std::vector<std::array<NodeId, width>>& wanted) {
  if (found.size() != wanted.size())
    return fmt::format("has {} {}, the mesh {}; it is a solution of another mesh; solve on this one",
                       found.size(), kind, wanted.size());
  const auto other = other_cell(found, wanted);
  if (!other) return {};
  std::string nodes;
  for (const NodeId node : *other) nodes += (nodes.empty() ? "" : " ") + std::to_string(node.value() + 1);
  return fmt::format(
      "its {} contain one with the nodes {}, which the mesh does not have; it is a solution of another mesh; "
      "solve on this one",
      kind, nodes);
}

/// The same for a distributed mesh, for owned nodes. *Collective.*
IdVector<NodeId, double> shortest_edges(const Communicator& comm, const Mesh& mesh) {
  struct OfNode {
    GlobalNodeId node;
    double shortest;
  };
  IdVector<NodeId, double> shortest = shortest_edges(mesh);
  const NodeOwners owners(comm, mesh.first_node);
  Outbox<OfNode> out;
  for (const NodeId node : ids_between(NodeId{mesh.owned_nodes}, NodeId{size32(mesh.points)}))
    out.add(owners.rank_of(mesh.global(node)), {mesh.global(node), shortest[node]});
  for (const auto& [node, of_node] : out.deliver(comm)) {
    double& least = shortest[owners.local(node)];
    least = std::min(least, of_node);
  }
  return shortest;
}

bool is_elsewhere(Point found, Point wanted, double square_of_shortest) {
  const Point way = found - wanted;
  return !(dot(way, way) <= same_place_tolerance * same_place_tolerance * square_of_shortest);
}

template <std::size_t width>
using GlobalCells = std::vector<std::array<GlobalNodeId, width>>;

/// Sends each cell, its nodes sorted, to the owner of its first node. *Collective.*
template <std::size_t width>
GlobalCells<width> cells_by_first_node(const Communicator& comm, const Mesh& mesh,
                                       const Cells<width>& cells) {
  const NodeOwners owners(comm, mesh.first_node);
  Outbox<std::array<GlobalNodeId, width>> out;
  for (const auto& nodes : cells) {
    std::array<GlobalNodeId, width> numbers;
    for (std::size_t k = 0; k < width; ++k) numbers[k] = mesh.global(nodes[k]);
    std::ranges::sort(numbers);
    out.add(owners.rank_of(numbers[0]), numbers);
  }
  GlobalCells<width> sorted = out.deliver(comm);
  std::ranges::sort(sorted);
  return sorted;
}

}  // namespace

NodeFlags nodes_elsewhere(const std::vector<Point>& points, const Mesh& mesh) {
  const IdVector<NodeId, double> shortest = shortest_edges(mesh);
  NodeFlags elsewhere(points.size(), 0);
  for (const NodeId node : elsewhere.ids())
    elsewhere[node] = is_elsewhere(points[node.value()], mesh.point(node), shortest[node]) ? 1 : 0;
  return elsewhere;
}

std::optional<std::array<NodeId, 3>> other_cell(const Cells<3>& found, const Cells<3>& wanted) {
  return first_other(found, wanted);
}

std::optional<std::array<NodeId, 4>> other_cell(const Cells<4>& found, const Cells<4>& wanted) {
  return first_other(found, wanted);
}

std::string node_difference(std::int64_t nodes, const std::vector<Point>& points, const Mesh& mesh) {
  if (nodes != std::ssize(mesh.points)) {
    return fmt::format(
        "holds values at {} nodes, the mesh has {}; it is a solution of another mesh; solve on this one",
        nodes, mesh.points.size());
  }
  if (points.empty()) return {};
  const NodeFlags elsewhere = nodes_elsewhere(points, mesh);
  const auto first = std::find(elsewhere.begin(), elsewhere.end(), 1);
  if (first == elsewhere.end()) return {};
  const std::size_t i = first - elsewhere.begin();
  const Point p = points[i], wanted = mesh.points[i];
  return fmt::format(
      "node {} lies at ({}, {}), in the mesh at ({}, {}); it is a solution of another mesh, or its rows are "
      "in another order; solve on this mesh "
      "and keep its order of nodes",
      i + 1, p.x, p.y, wanted.x, wanted.y);
}

std::string difference(const Mesh& found, const Mesh& whole) {
  std::string text = node_difference(std::ssize(found.points), found.points, whole);
  if (text.empty()) text = cell_difference("triangles", found.triangles, whole.triangles);
  if (text.empty()) text = cell_difference("quads", found.quads, whole.quads);
  return text;
}

bool has_same_nodes(const Communicator& comm, std::int64_t nodes, const std::vector<Point>& points,
                    const Mesh& mesh) {
  if (comm.any(nodes != comm.sum(mesh.owned_nodes))) return false;
  if (!comm.any(!points.empty())) return true;
  const IdVector<NodeId, double> shortest = shortest_edges(comm, mesh);
  bool same = std::ssize(points) >= mesh.owned_nodes;
  for (const NodeId node : ids_below(NodeId{same ? mesh.owned_nodes : 0}))
    same = same && !is_elsewhere(points[node.value()], mesh.point(node), shortest[node]);
  return !comm.any(!same);
}

bool is_same_mesh(const Communicator& comm, const Mesh& found, const Mesh& mesh) {
  if (!has_same_nodes(comm, comm.sum(found.owned_nodes), found.points, mesh)) return false;
  const bool same_triangles = cells_by_first_node(comm, found, found.triangles) ==
                              cells_by_first_node(comm, mesh, mesh.triangles),
             same_quads =
                 cells_by_first_node(comm, found, found.quads) == cells_by_first_node(comm, mesh, mesh.quads);
  return !comm.any(!same_triangles || !same_quads);
}

}  // namespace quadloop
