#include "tests/mesh/grid_mesh.hpp"

#include <algorithm>
#include <numeric>
#include <random>

namespace quadloop::test {

double scattered(std::uint64_t seed, std::int64_t number, int which) {
  std::seed_seq keys{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(number),
                     static_cast<std::uint32_t>(which)};
  std::mt19937_64 random(keys);
  return static_cast<double>(random() >> 11) * 0x1p-52 - 1;
}

bool Grid::inner(std::int32_t node) const {
  const std::int32_t i = node % (n + 1), j = node / (n + 1);
  return 0 < i && i < n && 0 < j && j < n;
}

Point Grid::place(std::int32_t node) const {
  return {size.x * (node % (n + 1)) / n, size.y * (node / (n + 1)) / n};
}

Mesh Grid::mesh() const {
  Mesh mesh;
  mesh.owned_nodes = (n + 1) * (n + 1);
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) mesh.points.push_back(place(node));
  const auto at = [&](std::int32_t i, std::int32_t j) { return NodeId{j * (n + 1) + i}; };
  for (std::int32_t j = 0; j < n; ++j) {
    for (std::int32_t i = 0; i < n; ++i) {
      const NodeId a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      const double kind = scattered(1, a.value(), 0);
      if (quads && kind < 0) {
        mesh.quads.push_back({a, b, c, d});
      } else if (kind < 0.5) {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, c}, {c, d, a}});
      } else {
        mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {d, b, c}});
      }
    }
  }
  mesh.boundaries = {{"wall", "wall", {}}, {"far", "farfield", {}}};
  for (std::int32_t k = 0; k < n; ++k) {
    mesh.boundaries[0].edges.push_back({at(k, 0), at(k + 1, 0)});
    mesh.boundaries[0].edges.push_back({at(n, k), at(n, k + 1)});
    mesh.boundaries[1].edges.push_back({at(n - k, n), at(n - k - 1, n)});
    mesh.boundaries[1].edges.push_back({at(0, n - k), at(0, n - k - 1)});
  }
  return mesh;
}

void jitter(const Grid& grid, double share, std::uint64_t seed, Mesh& mesh) {
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node) {
    const std::int32_t i = node % (grid.n + 1), j = node / (grid.n + 1);
    Point& p = mesh.points[node];
    if (0 < i && i < grid.n) p.x += share * grid.size.x / grid.n * scattered(seed, node, 1);
    if (0 < j && j < grid.n) p.y += share * grid.size.y / grid.n * scattered(seed, node, 2);
  }
}

namespace {

std::vector<std::int32_t> shuffled(std::size_t count, std::mt19937_64& random) {
  std::vector<std::int32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  std::shuffle(numbers.begin(), numbers.end(), random);
  return numbers;
}

}  // namespace

MeshOrder shuffled_order(const Mesh& whole, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  MeshOrder order;
  order.nodes = shuffled(whole.points.size(), random);
  order.triangles = shuffled(whole.triangles.size(), random);
  order.quads = shuffled(whole.quads.size(), random);
  return order;
}

}  // namespace quadloop::test
