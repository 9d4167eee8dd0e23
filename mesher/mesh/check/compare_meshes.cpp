#include "mesher/mesh/check/compare_meshes.hpp"

#include <algorithm>
#include <limits>

#include "mesher/mesh/topology.hpp"

namespace quadloop {

namespace {

template <std::size_t width>
using Cells = std::vector<std::array<NodeId, width>>;

/// The cells with the nodes of each in ascending order, and so the cells: the same list for the same cells.
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

/// The shortest edge at each node, squared.
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

bool same_cells_in_any_order(const Mesh& one, const Mesh& other) {
  return one.triangles.size() == other.triangles.size() && one.quads.size() == other.quads.size() &&
         !other_cell(one.triangles, other.triangles) && !other_cell(one.quads, other.quads);
}

std::optional<std::array<NodeId, 3>> other_cell(const Cells<3>& found, const Cells<3>& wanted) {
  return first_other(found, wanted);
}

std::optional<std::array<NodeId, 4>> other_cell(const Cells<4>& found, const Cells<4>& wanted) {
  return first_other(found, wanted);
}

}  // namespace quadloop
