#include "mesher/mesh/check/compare_meshes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

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

}  // namespace

NodeFlags nodes_elsewhere(const std::vector<Point>& points, const Mesh& mesh) {
  const IdVector<NodeId, double> shortest = shortest_edges(mesh);
  NodeFlags elsewhere(points.size(), 0);
  for (const NodeId node : elsewhere.ids()) {
    const Point way = points[node.value()] - mesh.point(node);
    elsewhere[node] = dot(way, way) <= same_place_tolerance * same_place_tolerance * shortest[node] ? 0 : 1;
  }
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

}  // namespace quadloop
