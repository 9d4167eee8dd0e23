// The order of a distributed mesh is that of the whole one, and a mesh that was moved to it comes back.
#include "mesher/mesh/reorder_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "mesher/base/morton.hpp"
#include "mesher/base/parallel/even_shares.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

Mesh jittered_grid(std::int32_t n) {
  const test::Grid grid{n};
  Mesh mesh = grid.mesh();
  test::jitter(grid, 0.2, 3, mesh);
  return mesh;
}

Mesh in_shares(const Mesh& whole) { return scatter_mesh(world(), whole, own_order(whole)); }

/// All ranks' numbers.
std::vector<std::int64_t> all_of(const std::vector<std::int64_t>& own) {
  return world().all_gather_values(std::span<const std::int64_t>(own));
}

/// The nodes of a whole mesh sorted by their keys in the unit square, then by their numbers.
std::vector<std::int64_t> sorted_by_curve(const Mesh& whole) {
  constexpr double steps = (std::uint64_t{1} << 31) - 1;
  std::vector<std::uint64_t> keys;
  for (const Point p : whole.points)
    keys.push_back(
        morton_key(static_cast<std::uint32_t>(p.x * steps), static_cast<std::uint32_t>(p.y * steps)));
  std::vector<std::int64_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](std::int64_t node) { return keys[node]; });
  return order;
}

TEST(PartOrder, IsThatOfTheWholeMesh) {
  for (const std::int32_t n : {1, 2, 9, 40}) {
    const Mesh whole = jittered_grid(n), part = in_shares(whole);
    const PartOrder order = space_filling_order(world(), part);
    EXPECT_EQ(all_of(order.nodes), sorted_by_curve(whole)) << n;
    const MeshOrder alone = space_filling_order(whole);
    EXPECT_TRUE(std::ranges::equal(all_of(order.nodes), alone.nodes));
    EXPECT_TRUE(std::ranges::equal(all_of(order.triangles), alone.triangles));
    EXPECT_TRUE(std::ranges::equal(all_of(order.quads), alone.quads));
    EXPECT_EQ(std::ssize(order.nodes), EvenShare(world(), std::ssize(whole.points)).size());
  }
}

TEST(PartOrder, CellsFollowTheirFirstNodes) {
  const Mesh whole = jittered_grid(9);
  const MeshOrder order = space_filling_order(whole);
  std::vector<std::int32_t> place(order.nodes.size());
  for (std::int32_t i = 0; i < std::ssize(order.nodes); ++i) place[order.nodes[i]] = i;
  const auto first_of = [&](const auto& nodes) {
    std::int32_t first = place[nodes[0].value()];
    for (const NodeId node : nodes) first = std::min(first, place[node.value()]);
    return first;
  };
  const auto by_first = [&](const auto& cells) {
    return [&](std::int32_t a, std::int32_t b) {
      return std::pair(first_of(cells[a]), a) < std::pair(first_of(cells[b]), b);
    };
  };
  EXPECT_TRUE(std::ranges::is_sorted(order.triangles, by_first(whole.triangles)));
  EXPECT_TRUE(std::ranges::is_sorted(order.quads, by_first(whole.quads)));
}

TEST(ReorderedMesh, IsTheMeshScatteredInThatOrder) {
  const Mesh whole = jittered_grid(9), part = in_shares(whole);
  const ReorderedMesh reordered(world(), part, space_filling_order(world(), part));
  const Mesh moved = reordered.mesh(part), wanted = scatter_mesh(world(), whole, space_filling_order(whole));
  EXPECT_EQ(moved.points, wanted.points);
  EXPECT_EQ(moved.triangles, wanted.triangles);
  EXPECT_EQ(moved.quads, wanted.quads);
  EXPECT_EQ(moved.ghosts, wanted.ghosts);
  for (std::size_t b = 0; b < whole.boundaries.size(); ++b)
    EXPECT_EQ(moved.boundaries[b].edges, wanted.boundaries[b].edges);
}

TEST(ReorderedMesh, ComesBackWithItsChanges) {
  for (const std::int32_t n : {1, 2, 7}) {
    const Mesh whole = jittered_grid(n);
    Mesh part = in_shares(whole);
    const ReorderedMesh reordered(world(), part, space_filling_order(world(), part));
    Mesh moved = reordered.take(part);
    EXPECT_EQ(part.points.capacity() + part.triangles.capacity() + part.quads.capacity(), 0U);
    for (Point& p : moved.points) p = 2.0 * p;
    for (auto& nodes : moved.triangles) std::ranges::rotate(nodes, nodes.begin() + 1);
    reordered.put_back(moved, part);
    const Mesh back = gather_whole(world(), part);
    if (!world().is_root()) continue;
    Mesh wanted = whole;
    for (Point& p : wanted.points) p = 2.0 * p;
    for (auto& nodes : wanted.triangles) std::ranges::rotate(nodes, nodes.begin() + 1);
    EXPECT_EQ(back.points, wanted.points);
    EXPECT_EQ(back.triangles, wanted.triangles);
    EXPECT_EQ(back.quads, wanted.quads);
    EXPECT_EQ(back.boundaries[0].edges, wanted.boundaries[0].edges);
  }
}

TEST(ReorderedMesh, MovesFieldsThereAndBack) {
  const Mesh whole = jittered_grid(7), part = in_shares(whole);
  Field field{{"x", "y"}, {}, {4}, {{"number"}, {}}};
  for (const Point p : std::span(part.points).first(part.owned_nodes))
    field.values.insert(field.values.end(), {p.x, p.y});
  for (std::size_t i = 0; i < part.cell_count(); ++i)
    field.cells.values.push_back(1000.0 * world().rank() + static_cast<double>(i));
  const ReorderedMesh reordered(world(), part, space_filling_order(world(), part));
  const Mesh moved = reordered.mesh(part);
  const Field there = reordered.field(field), back = reordered.field_back(there);
  for (std::int32_t i = 0; i < moved.owned_nodes; ++i) EXPECT_EQ(there.row(NodeId{i})[0], moved.points[i].x);
  EXPECT_EQ(there.cells.values.size(), moved.cell_count());
  EXPECT_EQ(back.values, field.values);
  EXPECT_EQ(back.cells.values, field.cells.values);
  EXPECT_EQ(back.constants, field.constants);
}

}  // namespace
}  // namespace quadloop
