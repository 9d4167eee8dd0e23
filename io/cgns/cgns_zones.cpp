#include "io/cgns/cgns_zones.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <utility>
#include <vector>

#include "mesher/geometry/point_table.hpp"
#include "mesher/mesh/topology.hpp"

namespace quadloop {

namespace {

/// Of each node the one of an earlier zone at its place, else itself.
std::vector<std::int32_t> first_at_place(const std::vector<Point>& points,
                                         std::span<const std::size_t> first_nodes) {
  const auto zone_of = [&](std::size_t node) { return std::ranges::upper_bound(first_nodes, node); };
  const PointTable table(points);
  std::vector<std::int32_t> first(points.size());
  for (std::size_t node = 0; node < points.size(); ++node) {
    const std::int32_t found = table.find(points[node]);
    first[node] = zone_of(found) == zone_of(node) ? static_cast<std::int32_t>(node) : found;
  }
  return first;
}

/// Takes out the nodes that stand for others; the new number of each.
std::vector<std::int32_t> drop_doubled(LoadedMesh& loaded, const std::vector<std::int32_t>& first) {
  std::vector<Point>& points = loaded.mesh.points;
  std::vector<double> no_values;
  std::vector<double>& values = loaded.solution ? loaded.solution->values : no_values;
  const std::size_t width = values.size() / points.size();
  std::vector<std::int32_t> number(points.size());
  std::int32_t kept = 0;
  for (std::size_t node = 0; node < points.size(); ++node) {
    if (first[node] != static_cast<std::int32_t>(node)) {
      number[node] = number[first[node]];
      continue;
    }
    points[kept] = points[node];
    std::copy_n(values.begin() + node * width, width, values.begin() + kept * width);
    number[node] = kept++;
  }
  points.resize(kept);
  values.resize(kept * width);
  return number;
}

std::int32_t block_of_cell(const LoadedMesh& loaded, std::size_t cell) {
  const std::size_t triangles = loaded.triangle_to_block.size();
  return cell < triangles ? loaded.triangle_to_block[cell] : loaded.quad_to_block[cell - triangles];
}

/// Each edge between two zones once.
void keep_first_mentions(LoadedMesh& loaded) {
  Mesh& mesh = loaded.mesh;
  const EdgeTable table(mesh);
  std::set<std::array<NodeId, 2>> taken;
  for (BoundaryEdges& boundary : mesh.boundaries) {
    std::erase_if(boundary.edges, [&](std::array<NodeId, 2>& edge) {
      const std::int32_t left = table.cell_left_of(edge[0], edge[1]),
                         right = table.cell_left_of(edge[1], edge[0]);
      if (left < 0 || right < 0) return false;
      if (block_of_cell(loaded, right) < block_of_cell(loaded, left)) std::swap(edge[0], edge[1]);
      return !taken.insert(edge).second;
    });
  }
  std::erase_if(mesh.boundaries, [](const BoundaryEdges& boundary) { return boundary.edges.empty(); });
}

}  // namespace

void unite_zones(LoadedMesh& loaded, std::span<const std::size_t> first_nodes) {
  if (first_nodes.size() < 2) return;
  Mesh& mesh = loaded.mesh;
  const std::vector<std::int32_t> number = drop_doubled(loaded, first_at_place(mesh.points, first_nodes));
  const auto renumber = [&](auto& rows) {
    for (auto& nodes : rows) {
      for (NodeId& node : nodes) node = NodeId{number[node.value()]};
    }
  };
  renumber(mesh.triangles);
  renumber(mesh.quads);
  for (BoundaryEdges& boundary : mesh.boundaries) renumber(boundary.edges);
  for (NodeId& node : loaded.periodic_nodes) node = NodeId{number[node.value()]};
  keep_first_mentions(loaded);
}

}  // namespace quadloop
