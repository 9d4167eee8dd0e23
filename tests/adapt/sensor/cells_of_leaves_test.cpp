// Each leaf gets its own cells' values, however leaves and cells are shared out.
#include "adapt/sensor/cells_of_leaves.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/base/error.hpp"
#include "tests/adapt/sensor/shared_leaves.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;
using Values = std::vector<double>;

/// A value for each cell of a rank that its number among triangles or quads over all ranks decides; some are
/// negative.
Values values_of(const Communicator& comm, const Mesh& mesh) {
  Values values;
  const std::size_t counts[] = {mesh.triangles.size(), mesh.quads.size()};
  for (int kind = 0; kind < 2; ++kind) {
    const auto own = static_cast<std::int64_t>(counts[kind]), first = comm.exclusive_sum(own);
    for (std::int64_t number = first; number < first + own; ++number)
      values.push_back(test::scattered(5, number, kind));
  }
  return values;
}

/// The same by the definition, leaf by leaf.
Values expected(const std::vector<LeafRecord>& leaves, bool largest) {
  Values of_leaves;
  std::int64_t triangle = 0, quad = 0;
  for (const LeafRecord& leaf : leaves) {
    Values cells;
    for (std::int32_t k = 0; k < leaf.triangles; ++k) cells.push_back(test::scattered(5, triangle++, 0));
    for (std::int32_t k = 0; k < leaf.quads; ++k) cells.push_back(test::scattered(5, quad++, 1));
    const auto [low, high] = std::minmax_element(cells.begin(), cells.end());
    of_leaves.push_back(cells.empty() ? 0 : largest ? *high : *low);
  }
  return of_leaves;
}

TEST(CellsOfLeaves, GiveEachLeafTheBestOfItsCells) {
  test::for_each_distribution([](const test::Pieces& pieces) {
    const std::vector<LeafRecord> leaves = test::leaves_of(pieces.whole, 4);
    const Values of_cells = values_of(world(), pieces.part);
    for (const test::Sharing sharing : test::all_sharings) {
      const std::vector<LeafRecord> own = test::share_of(leaves, sharing);
      const CellsOfLeaves cells(world(), pieces.part, own);
      EXPECT_EQ(cells.largest(world(), of_cells), test::share_of(expected(leaves, true), sharing));
      EXPECT_EQ(cells.smallest(world(), of_cells), test::share_of(expected(leaves, false), sharing));
    }
  });
}

TEST(CellsOfLeaves, RefuseATreeOfAnotherMesh) {
  const Mesh mesh = test::Grid{3}.mesh();
  const test::Pieces pieces(mesh, own_order(mesh));
  std::vector<LeafRecord> leaves = test::leaves_of(pieces.whole, 4);
  ++leaves.front().quads;
  const auto own = test::share_of(leaves, test::Sharing::uneven);
  EXPECT_THROW(CellsOfLeaves(world(), pieces.part, own), InputError);
}

TEST(CellsOfLeaves, MayBeNone) {
  const CellsOfLeaves cells(world(), {}, {});
  EXPECT_TRUE(cells.largest(world(), {}).empty());
}

}  // namespace
}  // namespace quadloop::adapt
