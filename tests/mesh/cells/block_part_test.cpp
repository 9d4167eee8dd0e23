// The parts of a mesh in its blocks are valid meshes, on any number of ranks; the order of cells along the
// quadtree is found again from a file's blocks.
#include "mesher/mesh/cells/block_part.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "mesher/base/error.hpp"
#include "mesher/base/parallel/even_shares.hpp"
#include "mesher/mesh/block_runs.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "tests/mesh/two_blocks.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

double area_of(const Mesh& mesh) {
  double area = 0;
  mesh.for_each_cell([&](const auto& nodes) {
    for (std::size_t k = 0; k < nodes.size(); ++k)
      area += 0.5 * cross(mesh.point(nodes[k]), mesh.point(nodes[(k + 1) % nodes.size()]));
  });
  return area;
}

TEST(BlockParts, AreMeshesOfTheirOwn) {
  const test::Grid grid{8, {2, 1}};
  const Mesh whole = test::two_blocks(grid);
  for (const bool shuffled : {false, true}) {
    const MeshOrder order = shuffled ? test::shuffled_order(whole, 5) : own_order(whole);
    const Mesh mesh = test::part_with_blocks(world(), whole, order);
    const std::vector<BlockPart> parts = block_parts(world(), mesh);
    ASSERT_EQ(parts.size(), 2);
    for (const BlockPart& part : parts) {
      const Mesh all = gather_whole(world(), part.mesh);
      if (!world().is_root()) continue;
      EXPECT_EQ(all.points.size(), 9 * 5);
      EXPECT_NEAR(area_of(all), 1, 1e-12);
      EXPECT_TRUE(validate(all).empty());
      ASSERT_EQ(all.boundaries.size(), 3);
      EXPECT_EQ(all.boundaries[2].name, "between");
      EXPECT_EQ(all.boundaries[2].edges.size(), 8);
    }
    for (const BlockPart& part : parts) {
      for (std::size_t i = 0; i < part.nodes.size(); ++i)
        EXPECT_EQ(part.mesh.points[i], mesh.point(part.nodes[i]));
    }
  }
}

TEST(BlockParts, HaveTheRowsOfTheField) {
  const Mesh whole = test::two_blocks({4});
  const Mesh mesh = test::part_with_blocks(world(), whole, own_order(whole));
  Field field{{"x"}, {}, {}, {{"block"}, {}}};
  for (std::int32_t node = 0; node < mesh.owned_nodes; ++node)
    field.values.push_back(mesh.point(NodeId{node}).x);
  for (const auto* blocks : {&mesh.blocks.of_triangles, &mesh.blocks.of_quads})
    field.cells.values.insert(field.cells.values.end(), blocks->begin(), blocks->end());
  double block = 0;
  for (const BlockPart& part : block_parts(world(), mesh)) {
    const Field own = field_on(part, field);
    for (std::int32_t node = 0; node < part.mesh.owned_nodes; ++node)
      EXPECT_EQ(own.values[node], part.mesh.points[node].x);
    EXPECT_EQ(own.cells.values, std::vector<double>(part.mesh.cell_count(), block));
    ++block;
  }
}

/// The cells sorted by block, as files store them.
Mesh by_block(const Mesh& whole) {
  Mesh sorted = whole;
  const auto sort = [](auto& cells, std::vector<std::int32_t>& blocks) {
    auto left = cells;
    left.clear();
    for (const std::int32_t block : {0, 1}) {
      for (std::size_t i = 0; i < cells.size(); ++i) {
        if (blocks[i] == block) left.push_back(cells[i]);
      }
    }
    cells = left;
    std::ranges::sort(blocks);
  };
  sort(sorted.triangles, sorted.blocks.of_triangles);
  sort(sorted.quads, sorted.blocks.of_quads);
  return sorted;
}

TEST(BlockRuns, GiveTheOrderOfTheCellsBack) {
  const Mesh whole = test::two_blocks({6});
  const Mesh mesh = test::part_with_blocks(world(), whole, own_order(whole));
  const std::vector<BlockRun> runs = block_runs(world(), mesh);
  const Mesh file = by_block(whole);
  const Mesh part = test::part_with_blocks(world(), file, own_order(file));
  const PartOrder order = order_by_runs(world(), part, runs);
  const EvenShare triangles(world(), std::ssize(whole.triangles)), quads(world(), std::ssize(whole.quads));
  ASSERT_EQ(std::ssize(order.triangles), triangles.size());
  for (std::int64_t i = 0; i < triangles.size(); ++i)
    EXPECT_EQ(file.triangles[order.triangles[i]], whole.triangles[triangles.begin + i]);
  for (std::int64_t i = 0; i < quads.size(); ++i)
    EXPECT_EQ(file.quads[order.quads[i]], whole.quads[quads.begin + i]);
  Mesh again = ReorderedMesh(world(), part, order).mesh(part);
  set_blocks(world(), whole.blocks.names, runs, again);
  EXPECT_EQ(again.triangles, mesh.triangles);
  EXPECT_EQ(again.quads, mesh.quads);
  EXPECT_EQ(again.blocks.of_triangles, mesh.blocks.of_triangles);
  EXPECT_EQ(again.blocks.of_quads, mesh.blocks.of_quads);
}

TEST(BlockRuns, RefuseBlocksOfOtherSizes) {
  const Mesh whole = test::two_blocks({6});
  const Mesh mesh = test::part_with_blocks(world(), whole, own_order(whole));
  const std::vector<BlockRun> runs = block_runs(world(), mesh);
  Mesh other = by_block(whole);
  other.blocks.of_quads.back() = 0;
  EXPECT_THROW(order_by_runs(world(), test::part_with_blocks(world(), other, own_order(other)), runs),
               InputError);
  std::vector<BlockRun> longer = runs;
  longer.back().cells += 1;
  EXPECT_THROW(order_by_runs(world(), mesh, longer), InputError);
  EXPECT_TRUE(block_runs(world(), scatter_mesh(world(), whole, own_order(whole))).empty());
}

}  // namespace
}  // namespace quadloop
