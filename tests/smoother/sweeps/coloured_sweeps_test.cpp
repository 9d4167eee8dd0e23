// Who is visited: all that are stale, then those round which something has moved, also by later sweeps over
// the same flags.
#include "smoother/sweeps/coloured_sweeps.hpp"

#include <gtest/gtest.h>

#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::smoother {
namespace {

using test::world;

/// A grid's share of this rank, all owned nodes free.
struct Sweeps {
  explicit Sweeps(int n)
      : whole{test::Grid{n}.mesh()},
        part{scatter_mesh(world(), whole, space_filling_order(whole))},
        halo(world(), part),
        stars(halo, owned(), {}),
        stale(halo.points().size(), 1),
        coloured(world(), halo, stars, stale) {}

  std::vector<NodeId> owned() const {
    const auto nodes = ids_below(NodeId{part.owned_nodes});
    return {nodes.begin(), nodes.end()};
  }
  /// How many are visited over all ranks; the node of a global number goes a little to the right.
  std::int64_t visits(ColouredSweeps& sweeps, std::int64_t moving = -1) {
    std::int64_t count = 0;
    sweeps.sweep(
        stars.all(), [](std::size_t) { return true; },
        [&](std::size_t i) -> std::optional<Point> {
          ++count;
          const NodeId node = stars.nodes()[i];
          if (halo.global(node).value() != moving) return std::nullopt;
          return halo.point(node) + Point{0.01, 0};
        });
    return world().sum(count);
  }

  Mesh whole, part;
  HaloMesh halo;
  NodeStars stars;
  NodeFlags stale;
  ColouredSweeps coloured;
};

TEST(ColouredSweeps, VisitWhatIsStaleAndThenWhatIsRoundMovedNodes) {
  Sweeps grid(6);
  EXPECT_EQ(grid.visits(grid.coloured), 49);
  EXPECT_EQ(grid.visits(grid.coloured), 0);
  for (std::int64_t node = 0; node < 49; ++node) {
    std::int64_t round = 0;  // of the node that is to move: itself and its neighbours
    for (std::size_t i = 0; i < grid.stars.size(); ++i) {
      bool near = grid.halo.global(grid.stars.nodes()[i]).value() == node;
      grid.stars.for_each_neighbour(
          i, [&](NodeId other) { near = near || grid.halo.global(other).value() == node; });
      round += near ? 1 : 0;
    }
    for (const NodeId own : grid.owned()) {
      if (grid.halo.global(own).value() == node) grid.stale[own] = 1;
    }
    // Those of later colours are visited in the same sweep.
    EXPECT_EQ(grid.visits(grid.coloured, node) + grid.visits(grid.coloured), 1 + world().sum(round)) << node;
    EXPECT_EQ(grid.visits(grid.coloured), 0);
  }
}

TEST(ColouredSweeps, TellOnceWhatHasChanged) {
  Sweeps grid(6);
  EXPECT_EQ(grid.visits(grid.coloured), 49);
  EXPECT_TRUE(grid.coloured.take_changed().empty()) << "nothing has moved";
  for (const NodeId own : grid.owned()) grid.stale[own] = 1;
  constexpr std::int64_t moving = 24;
  grid.visits(grid.coloured, moving);
  std::vector<std::int32_t> expected;  // itself and its neighbours
  for (const std::int32_t i : grid.stars.all()) {
    bool near = grid.halo.global(grid.stars.nodes()[i]).value() == moving;
    grid.stars.for_each_neighbour(
        i, [&](NodeId other) { near = near || grid.halo.global(other).value() == moving; });
    if (near) expected.push_back(i);
  }
  EXPECT_EQ(grid.coloured.take_changed(), expected);
  EXPECT_TRUE(grid.coloured.take_changed().empty());
}

/// Not even those that are stale: they are visited if they are named and active.
TEST(ColouredSweeps, VisitWhoIsNamedAndActiveAlone) {
  Sweeps grid(6);
  std::vector<std::int32_t> visited;
  const std::vector<std::int32_t> named =
      grid.stars.size() > 1 ? std::vector<std::int32_t>{0, 1} : std::vector<std::int32_t>{};
  grid.coloured.sweep(
      named, [](std::size_t i) { return i == 1; },
      [&](std::size_t i) -> std::optional<Point> {
        visited.push_back(static_cast<std::int32_t>(i));
        return std::nullopt;
      });
  EXPECT_EQ(visited, named.empty() ? std::vector<std::int32_t>{} : std::vector<std::int32_t>{1});
}

TEST(ColouredSweeps, FlagsOutliveThem) {
  Sweeps grid(4);
  EXPECT_EQ(grid.visits(grid.coloured), 25);
  ColouredSweeps later(world(), grid.halo, grid.stars, grid.stale);
  EXPECT_EQ(grid.visits(later), 0);
  for (const NodeId own : grid.owned()) grid.stale[own] = 1;
  EXPECT_EQ(grid.visits(later), 25);
}

}  // namespace
}  // namespace quadloop::smoother
