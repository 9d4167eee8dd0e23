#include "adapt/transfer/overlap/broken_field.hpp"

#include <algorithm>

#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"

namespace quadloop::adapt {

namespace {

BrokenField without_values(const Mesh& mesh, std::size_t width, std::span<const CellTriangle> triangles) {
  BrokenField broken;
  broken.width = width;
  for (const CellTriangle& triangle : triangles) {
    const auto& [a, b, c] = triangle.nodes;
    broken.triangles.push_back({mesh.point(a), mesh.point(b), mesh.point(c)});
    broken.numbers.push_back(triangle.number);
  }
  broken.at_corners.resize(3 * triangles.size() * width);
  return broken;
}

/// The gradient of one cell: the mean gradient of its nodes that have one, limited at each node.
template <class Nodes>
Point limited_gradient(const Mesh& mesh, const Nodes& nodes, Point from_first, double mean,
                       const std::vector<AroundNode>& around) {
  Point sum;
  double count = 0;
  for (const NodeId node : nodes) {
    if (!around[node.value()].has_gradient) continue;
    sum = sum + around[node.value()].gradient;
    count += 1;
  }
  if (count == 0) return {};
  const Point gradient = (1 / count) * sum;
  double share = 1;
  for (const NodeId node : nodes) {
    const double change = dot(gradient, mesh.point(node) - mesh.point(nodes[0]) - from_first);
    const AroundNode& here = around[node.value()];
    if (change > 0) share = std::min(share, (here.largest - mean) / change);
    if (change < 0) share = std::min(share, (here.smallest - mean) / change);
  }
  return share * gradient;
}

std::vector<Point> limited_gradients(const Mesh& mesh, const CellsRoundNodes& round_nodes,
                                     const std::vector<double>& means,
                                     const std::vector<AroundNode>& around) {
  std::vector<Point> gradients;
  const auto append = [&](const auto& cells) {
    for (const auto& nodes : cells) {
      const std::size_t cell = gradients.size();
      gradients.push_back(
          limited_gradient(mesh, nodes, round_nodes.shapes()[cell].from_first, means[cell], around));
    }
  };
  append(mesh.triangles);
  append(mesh.quads);
  return gradients;
}

Point first_corner(const Mesh& mesh, std::int64_t cell) {
  const auto triangles = std::ssize(mesh.triangles);
  return mesh.point(cell < triangles ? mesh.triangles[cell][0] : mesh.quads[cell - triangles][0]);
}

}  // namespace

BrokenField broken_nodal(const Mesh& mesh, const Field& field, std::span<const CellTriangle> triangles) {
  BrokenField broken = without_values(mesh, field.width(), triangles);
  auto to = broken.at_corners.begin();
  for (const CellTriangle& triangle : triangles) {
    for (const NodeId node : triangle.nodes) to = std::ranges::copy(field.row(node), to).out;
  }
  return broken;
}

BrokenField broken_cells(const Communicator& comm, const Mesh& mesh, const CellValues& cells,
                         std::span<const CellTriangle> triangles) {
  const std::size_t width = cells.width();
  BrokenField broken = without_values(mesh, width, triangles);
  const CellsRoundNodes round_nodes(comm, mesh);
  const CellOwners owners(comm, mesh);
  for (std::size_t k = 0; k < width; ++k) {
    const std::vector<double> means = cells.column(k);
    const std::vector<AroundNode> around = round_nodes.of(means);
    const std::vector<Point> gradients = limited_gradients(mesh, round_nodes, means, around);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const std::int64_t cell = owners.local(triangles[i].number / 2);
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const NodeId node = triangles[i].nodes[corner];
        const Point from_first = mesh.point(node) - first_corner(mesh, cell);
        const double change = dot(gradients[cell], from_first - round_nodes.shapes()[cell].from_first);
        broken.at_corners[(3 * i + corner) * width + k] =
            std::clamp(means[cell] + change, around[node.value()].smallest, around[node.value()].largest);
      }
    }
  }
  return broken;
}

}  // namespace quadloop::adapt
