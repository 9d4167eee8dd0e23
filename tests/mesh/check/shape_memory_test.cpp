// What the figures of shapes hold beside the mesh, by counting what is asked of the heap.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <new>

#include "mesher/mesh/check/solver_statistics.hpp"
#include "tests/support/world.hpp"

namespace {

std::size_t held = 0, most_held = 0;

}  // namespace

void* operator new(std::size_t bytes) {
  void* block = std::malloc(bytes);
  if (block == nullptr) throw std::bad_alloc();
  held += malloc_usable_size(block);
  most_held = std::max(most_held, held);
  return block;
}
void operator delete(void* block) noexcept {
  held -= malloc_usable_size(block);
  std::free(block);
}
void operator delete(void* block, std::size_t /*bytes*/) noexcept { operator delete(block); }

namespace quadloop {
namespace {

using test::world;

/// n x n squares, one of their nodes moved, the outline one boundary.
Mesh squares(std::int32_t n) {
  Mesh mesh;
  const auto node = [n](std::int32_t column, std::int32_t row) { return NodeId{row * (n + 1) + column}; };
  for (std::int32_t row = 0; row <= n; ++row) {
    for (std::int32_t column = 0; column <= n; ++column)
      mesh.points.push_back({static_cast<double>(column), static_cast<double>(row)});
  }
  mesh.points[node(n / 2, n / 2).value()] = {n / 2 + 0.4, n / 2 + 0.4};
  mesh.owned_nodes = (n + 1) * (n + 1);
  mesh.boundaries = {{"wall", "wall", {}}};
  auto& edges = mesh.boundaries[0].edges;
  for (std::int32_t i = 0; i < n; ++i) {
    for (std::int32_t k = 0; k < n; ++k)
      mesh.quads.push_back({node(k, i), node(k + 1, i), node(k + 1, i + 1), node(k, i + 1)});
    edges.push_back({node(i, 0), node(i + 1, 0)});
    edges.push_back({node(n, i), node(n, i + 1)});
    edges.push_back({node(i + 1, n), node(i, n)});
    edges.push_back({node(0, i + 1), node(0, i)});
  }
  return mesh;
}

TEST(ShapeMemory, IsLessThanTheMeshs) {
  constexpr std::int32_t n = 400;
  constexpr double bytes_of_node = 16 + 16 + 1 + 1;  // positions, smallest and largest areas, two flags
  const Mesh mesh = squares(n);
  const std::size_t before = held;
  most_held = held;
  const SolverStatistics statistics = solver_statistics(world(), mesh);
  EXPECT_EQ(statistics.inexact_nodes, 8);  // of the nine of the four cells that are no squares
  EXPECT_NEAR(statistics.area_ratio_max, 1 / 0.6, 1e-6);
  EXPECT_LT(static_cast<double>(most_held - before) / mesh.owned_nodes, 1.1 * bytes_of_node);
}

}  // namespace
}  // namespace quadloop
