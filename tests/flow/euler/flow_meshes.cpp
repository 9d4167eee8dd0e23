#include "tests/flow/euler/flow_meshes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/mesh/grid_mesh.hpp"

namespace quadloop::test {

Mesh irregular_grid(std::int32_t n, Point size, double jitter_share, bool quads) {
  const Grid grid{n, size, quads};
  Mesh mesh = grid.mesh();
  jitter(grid, jitter_share, 7, mesh);
  return mesh;
}

void relabel(Mesh& mesh, const std::function<std::string(Point)>& name_of) {
  std::vector<BoundaryEdges> named;
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (const auto& edge : boundary.edges) {
      const std::string name = name_of(0.5 * (mesh.point(edge[0]) + mesh.point(edge[1])));
      auto found =
          std::find_if(named.begin(), named.end(), [&](const BoundaryEdges& b) { return b.name == name; });
      if (found == named.end())
        found = named.insert(named.end(),
                             {name, BoundaryCondition::named(name).value_or(BoundaryCondition()), {}});
      found->edges.push_back(edge);
    }
  }
  mesh.boundaries = named;
}

Mesh wedge_mesh(std::int32_t n, double degrees) {
  const Grid grid{n, {1.5, 1}, true};
  Mesh mesh;
  mesh.owned_nodes = (n + 1) * (n + 1);
  const double slope = std::tan(degrees * std::numbers::pi / 180);
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    const Point p = grid.place(node);
    const double floor = std::max(0.0, (p.x - 0.5) * slope);
    mesh.points.push_back({p.x, floor + (1 - floor) * p.y});
  }
  const auto at = [&](std::int32_t i, std::int32_t j) { return NodeId{j * (n + 1) + i}; };
  for (std::int32_t j = 0; j < n; ++j) {
    for (std::int32_t i = 0; i < n; ++i)
      mesh.quads.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  }
  mesh.boundaries = {{"inflow", "inflow", {}},
                     {"outflow", "outflow", {}},
                     {"farfield", "farfield", {}},
                     {"symmetry", "symmetry", {}},
                     {"wall", "wall", {}}};
  for (std::int32_t k = 0; k < n; ++k) {
    mesh.boundaries[0].edges.push_back({at(0, k + 1), at(0, k)});
    mesh.boundaries[1].edges.push_back({at(n, k), at(n, k + 1)});
    mesh.boundaries[2].edges.push_back({at(k + 1, n), at(k, n)});
    mesh.boundaries[3 * k < n ? 3 : 4].edges.push_back({at(k, 0), at(k + 1, 0)});
  }
  return mesh;
}

Mesh ring_mesh(std::int32_t around, std::int32_t outwards, double thickness, double far) {
  Mesh mesh;
  mesh.owned_nodes = around * (outwards + 1);
  for (std::int32_t j = 0; j <= outwards; ++j) {
    const double share = static_cast<double>(j) / outwards, radius = 0.5 * std::pow(2 * far, share);
    for (std::int32_t i = 0; i < around; ++i) {
      const std::int32_t upper =
          std::min(i, around - i);  // the lower half mirrors the upper one to the last bit
      const double angle = 2 * std::numbers::pi * upper / around;
      const double flat = thickness + (1 - thickness) * share,
                   y = upper % (around / 2) == 0 ? 0 : radius * flat * std::sin(angle);
      mesh.points.push_back({radius * std::cos(angle), i == upper ? y : -y});
    }
  }
  const auto at = [&](std::int32_t i, std::int32_t j) { return NodeId{j * around + i % around}; };
  mesh.boundaries = {{"wall", "wall", {}}, {"farfield", "farfield", {}}};
  for (std::int32_t i = 0; i < around; ++i) {
    for (std::int32_t j = 0; j < outwards; ++j)
      mesh.quads.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)});
    mesh.boundaries[0].edges.push_back({at(i + 1, 0), at(i, 0)});
    mesh.boundaries[1].edges.push_back({at(i, outwards), at(i + 1, outwards)});
  }
  return mesh;
}

}  // namespace quadloop::test
