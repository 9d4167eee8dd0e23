// The cells that two meshes have in common: those with the same corners, whatever the ranks and orders.
#include "adapt/transfer/equal_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "mesher/mesh/cells/cell_owners.hpp"
#include "mesher/mesh/cells/cells_round_nodes.hpp"
#include "tests/adapt/transfer/jittered_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::Grid;
using test::world;

constexpr std::int32_t moved_node = 5 * 13 + 6;  // inside, of 13 x 13 nodes

/// A grid of cells of both kinds, and the same with one node moved, its cells and their corners in another
/// order.
struct TwoMeshes {
  test::WholeMesh before = test::jittered(Grid{12}, 0.2, 3), after = before;

  TwoMeshes() {
    after.mesh.points[moved_node] = after.mesh.points[moved_node] + Point{0.01, 0};
    for (auto& nodes : after.mesh.quads) std::ranges::rotate(nodes, nodes.begin() + 1);
    for (auto& nodes : after.mesh.triangles) std::ranges::rotate(nodes, nodes.begin() + 2);
    after.order = test::shuffled_order(after.mesh, 11);
  }
};

std::vector<double> centroid_rows(const Mesh& mesh) {
  std::vector<double> rows;
  for (const CellShape& shape : cell_shapes(mesh))
    rows.insert(rows.end(), {shape.centroid.x, shape.centroid.y});
  return rows;
}

/// The number of the old cell at each new one, or -1.
std::vector<std::int64_t> numbers_of(const EqualCells& equal, const CellOwners& owners) {
  std::vector<std::int64_t> numbers;
  auto next = equal.numbers.begin();
  for (const std::int32_t old : equal.old_cell)
    numbers.push_back(old >= 0 ? owners.number(old) : old == EqualCells::elsewhere ? *next++ : -1);
  EXPECT_EQ(next, equal.numbers.end());
  return numbers;
}

TEST(EqualCells, AreAllThatAreNotAtAMovedNode) {
  const TwoMeshes meshes;
  const Mesh old_mesh = meshes.before.part(world()), new_mesh = meshes.after.part(world());
  const EqualCells equal = find_equal_cells(world(), old_mesh, new_mesh, new_mesh.points);
  const CellOwners owners(world(), old_mesh);
  std::vector<std::int64_t> numbers = numbers_of(equal, owners);
  ASSERT_EQ(numbers.size(), new_mesh.cell_count());
  std::int64_t changed = 0, at_moved = 0;
  std::size_t cell = 0;
  new_mesh.for_each_cell([&](const auto& nodes) {
    const bool is_at_moved = std::ranges::any_of(
        nodes, [&](NodeId node) { return new_mesh.point(node) == meshes.after.mesh.points[moved_node]; });
    EXPECT_EQ(numbers[cell++] < 0, is_at_moved);
    at_moved += is_at_moved ? 1 : 0;
  });
  changed = std::ranges::count(equal.old_changed, 1);
  EXPECT_EQ(equal.old_changed.size(), old_mesh.cell_count());
  EXPECT_EQ(world().sum(changed), world().sum(at_moved));
  EXPECT_GT(world().sum(at_moved), 0);
  const std::vector<double> of_new = centroid_rows(new_mesh);
  for (std::int64_t& number : numbers) number = std::max<std::int64_t>(number, 0);
  const std::vector<double> of_old =
      rows_of_cells(world(), owners, std::span<const std::int64_t>(numbers), centroid_rows(old_mesh), 2);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (equal.is_changed(i)) continue;
    EXPECT_NEAR(of_old[2 * i], of_new[2 * i], 1e-15);
    EXPECT_NEAR(of_old[2 * i + 1], of_new[2 * i + 1], 1e-15);
  }
}

TEST(EqualCells, WithoutQuadrilateralsOnlyTrianglesAre) {
  const Mesh mesh = test::jittered(Grid{12}, 0.2, 3).part(world());
  const EqualCells equal = find_equal_cells(world(), mesh, mesh, mesh.points, false);
  for (std::size_t cell = 0; cell < mesh.cell_count(); ++cell) {
    EXPECT_EQ(equal.is_changed(cell), cell >= mesh.triangles.size());
    EXPECT_EQ(equal.old_changed[cell], cell >= mesh.triangles.size() ? 1 : 0);
  }
}

}  // namespace
}  // namespace quadloop::adapt
