// Cells and other items reach the root in the order that they have in the whole mesh.
#include "io/plot/cell_stream.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <vector>

#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/io/sample_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::io {
namespace {

using test::world;

TEST(HandToRoot, KeepsTheOrderOfRanksInManyPieces) {
  const std::int64_t own = world().rank() % 2 == 0 ? 10000 + world().rank() : 0;  // some ranks have nothing
  const std::int64_t first = world().exclusive_sum(own);
  std::vector<std::int64_t> seen;
  hand_to_root(
      world(), static_cast<std::size_t>(own),
      [&](std::size_t i) { return first + static_cast<std::int64_t>(i); },
      [&](std::int64_t item) { seen.push_back(item); });
  const std::int64_t all = world().sum(own);
  std::vector<std::int64_t> wanted(world().is_root() ? all : 0);
  std::iota(wanted.begin(), wanted.end(), 0);
  EXPECT_EQ(seen, wanted);
}

TEST(CellStream, HandsTrianglesThenQuadsOfTheWholeMesh) {
  const Mesh whole = test::sample_mesh(9);
  const Mesh mesh = scatter_mesh(world(), whole, own_order(whole));
  std::vector<std::size_t> cells(mesh.cell_count());
  std::iota(cells.begin(), cells.end(), 0);
  std::vector<double> values;
  for (const Point& p : mesh.points) values.push_back(p.x + 100 * p.y);
  std::vector<ShownCell> seen;
  CellStream(world(), mesh).for_each(cells, values, [&](const ShownCell& cell) { seen.push_back(cell); });
  if (!world().is_root()) {
    EXPECT_TRUE(seen.empty());
    return;
  }
  ASSERT_EQ(seen.size(), whole.cell_count());
  auto cell = seen.begin();
  whole.for_each_cell([&](const auto& nodes) {
    ASSERT_EQ(cell->width, size32(nodes));
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Point p = whole.point(nodes[k]);
      EXPECT_EQ(cell->corners[k], p);
      EXPECT_EQ(cell->values[k], p.x + 100 * p.y);
    }
    ++cell;
  });
}

}  // namespace
}  // namespace quadloop::io
