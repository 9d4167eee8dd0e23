// Which nodes are visited: after the open sweeps those near no bad cell are left out.
#include "smoother/sweeps/sweeper.hpp"

#include <gtest/gtest.h>

#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::smoother {
namespace {

using test::world;

/// A jittered grid's share of this rank, inner nodes free and all of them said to be bad.
struct Jittered {
  explicit Jittered(double threshold)
      : whole{jittered()},
        part{scatter_mesh(world(), whole, space_filling_order(whole))},
        halo(world(), part),
        slide(world(), halo, part.boundaries, nullptr, pinned),
        stars(halo, inner(), {}),
        bad(halo.points().size(), 1),
        stale(halo.points().size(), 1),
        rule{Method::perturb, Objective::power, threshold, false} {}

  static Mesh jittered() {
    Mesh mesh = grid.mesh();
    jitter(grid, 0.2, 3, mesh);
    return mesh;
  }
  std::vector<NodeId> inner() const {
    std::vector<NodeId> nodes;
    for (const NodeId node : ids_below(NodeId{part.owned_nodes})) {
      if (slide.freedom(node) == NodeFreedom::interior) nodes.push_back(node);
    }
    return nodes;
  }
  Sweeper sweeper() { return {world(), halo, stars, slide, rule, bad, stale}; }

  static constexpr test::Grid grid{.n = 24, .quads = false};
  Mesh whole, part;
  HaloMesh halo;
  NodeFlags pinned;
  BoundarySlide slide;
  NodeStars stars;
  NodeFlags bad, stale;
  Sweeper::Rule rule;
};

TEST(Sweeper, AfterTheOpenSweepsNodesNearNoBadCellStay) {
  constexpr double no_cell = 0.99;
  Jittered mesh(no_cell);
  Sweeper sweeper = mesh.sweeper();
  for (int open = 0; open < Sweeper::open_sweeps; ++open) EXPECT_GT(sweeper.sweep(), 0);
  EXPECT_EQ(sweeper.sweep(), 0);
  Sweeper next_round = mesh.sweeper();
  EXPECT_GT(next_round.sweep(), 0) << "nothing was left to move";
}

TEST(Sweeper, AfterTheOpenSweepsNodesNearBadCellsMove) {
  constexpr double every_cell = 0;
  Jittered mesh(every_cell);
  Sweeper sweeper = mesh.sweeper();
  for (int open = 0; open < Sweeper::open_sweeps; ++open) EXPECT_GT(sweeper.sweep(), 0);
  EXPECT_GT(sweeper.sweep(), 0);
}

}  // namespace
}  // namespace quadloop::smoother
