// Stars of nodes: their corners, neighbours and costs.
#include "smoother/sweeps/node_stars.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::smoother {
namespace {

using test::world;

Mesh jittered_grid() {
  const test::Grid grid{7, {1, 1}, true};
  Mesh mesh = grid.mesh();
  jitter(grid, 0.2, 11, mesh);
  return mesh;
}

struct Stars {
  Stars(const Communicator& comm, const Mesh& whole, const std::vector<CellTarget>& of_whole = {})
      : part{scatter_mesh(comm, whole, space_filling_order(whole))},
        halo(comm, part),
        stars(halo, all_owned(), of_whole.empty() ? of_whole : targets(comm)) {}
  std::vector<NodeId> all_owned() const {
    const auto owned = ids_below(NodeId{part.owned_nodes});
    return {owned.begin(), owned.end()};
  }
  /// One for all cells.
  std::vector<CellTarget> targets(const Communicator& comm) const {
    const std::vector<CellTarget> own(part.triangles.size() + part.quads.size(), CellTarget{{2, 0}, {0, 1}});
    return halo.spread(comm, own);
  }
  Star star(std::size_t i) const {
    Star result;
    stars.gather(i, result);
    return result;
  }
  Mesh part;
  HaloMesh halo;
  NodeStars stars;
};

TEST(NodeStars, HaveACornerOfEachTriangleAndThreeOfEachQuad) {
  const Stars all(world(), jittered_grid());
  std::vector<std::size_t> expected(all.part.owned_nodes, 0);
  all.halo.for_each_cell([&](const auto& cell) {
    for (const NodeId node : cell) {
      if (node.value() < all.part.owned_nodes) expected[node.value()] += cell.size() == 3 ? 1 : 3;
    }
  });
  for (std::size_t i = 0; i < all.stars.size(); ++i) EXPECT_EQ(all.star(i).corners().size(), expected[i]);
}

void expect_neighbours_share_a_cell(const Mesh& mesh) {
  const Stars all(world(), mesh);
  std::vector<std::set<NodeId>> expected(all.part.owned_nodes);
  all.halo.for_each_cell([&](const auto& cell) {
    for (const NodeId node : cell) {
      for (const NodeId other : cell) {
        if (node.value() < all.part.owned_nodes && other != node) expected[node.value()].insert(other);
      }
    }
  });
  for (std::size_t i = 0; i < all.stars.size(); ++i) {
    std::set<NodeId> found;
    all.stars.for_each_neighbour(i, [&](NodeId other) { found.insert(other); });
    EXPECT_EQ(found, expected[i]);
    EXPECT_EQ(all.stars.star_of(all.stars.nodes()[i]), static_cast<std::int32_t>(i));
  }
}

TEST(NodeStars, NeighboursShareACell) { expect_neighbours_share_a_cell(jittered_grid()); }

/// Inside such a mesh each neighbour is met once, at its border the last one of a fan is not forgotten.
TEST(NodeStars, NeighboursShareATriangle) {
  expect_neighbours_share_a_cell(test::Grid{.n = 6, .quads = false}.mesh());
}

/// Of each node of another rank the stars whose neighbour it is.
TEST(NodeStars, AreFoundRoundEachOfOtherRanksNodes) {
  const Stars all(world(), jittered_grid());
  std::map<NodeId, std::multiset<std::int32_t>> expected;
  for (std::size_t i = 0; i < all.stars.size(); ++i)
    all.stars.for_each_neighbour(i, [&](NodeId other) {
      if (!all.halo.owns(other)) expected[other].insert(static_cast<int>(i));
    });
  EXPECT_EQ(expected.empty(), world().size() == 1);
  for (const auto& [node, stars] : expected) {
    std::multiset<std::int32_t> found;
    all.stars.for_each_star_round(node, [&](std::int32_t star) { found.insert(star); });
    EXPECT_EQ(found, stars) << node.value();
  }
}

TEST(NodeStars, CostTheSameOnAnyNumberOfRanks) {
  const Communicator self(MPI_COMM_SELF);
  const std::vector<CellTarget> stretched(1, CellTarget{{2, 0}, {0, 1}});
  for (const auto& targets : {std::vector<CellTarget>{}, stretched}) {
    const Stars together(world(), jittered_grid(), targets), alone(self, jittered_grid(), targets);
    for (std::size_t i = 0; i < together.stars.size(); ++i) {
      const NodeId own = together.stars.nodes()[i];
      const std::size_t number = together.part.global(own).value();
      const Point p = together.part.point(own);
      EXPECT_EQ(together.star(i).worst_cost(p), alone.star(number).worst_cost(p));
      EXPECT_EQ(together.star(i).cost(p, Objective::power).objective[0],
                alone.star(number).cost(p, Objective::power).objective[0]);
    }
  }
}

TEST(NodeStars, TellWhetherACornerCostsMore) {
  const Stars all(world(), jittered_grid());
  int more = 0;
  for (std::size_t i = 0; i < all.stars.size(); ++i) {
    const double worst = all.star(i).worst_cost(all.part.point(all.stars.nodes()[i]));
    EXPECT_EQ(all.stars.costs_more(i, 0.05), worst > 0.05);
    if (worst == 0 || worst >= 1) continue;
    EXPECT_TRUE(all.stars.costs_more(i, worst * (1 - 1e-9)));
    EXPECT_FALSE(all.stars.costs_more(i, worst * (1 + 1e-9)));
    ++more;
  }
  EXPECT_EQ(more > 0, all.stars.size() > 0);
}

TEST(NodeStars, AnInvertedCornerCostsMoreThanAnyLimit) {
  Mesh whole;
  whole.points = {{0, 0}, {1, 0}, {0, 1}};
  whole.owned_nodes = 3;
  whole.triangles = {{NodeId{0}, NodeId{2}, NodeId{1}}};
  const Stars all(Communicator(MPI_COMM_SELF), whole);
  for (std::size_t i = 0; i < all.stars.size(); ++i) EXPECT_TRUE(all.stars.costs_more(i, 0.999));
}

TEST(NodeStars, OfIdealCellsCostNothing) {
  Mesh whole;  // two unit squares
  for (const double y : {0.0, 1.0}) {
    for (const double x : {0.0, 1.0, 2.0}) whole.points.push_back({x, y});
  }
  whole.owned_nodes = 6;
  const auto n = [](std::int32_t number) { return NodeId{number}; };
  whole.quads = {{n(0), n(1), n(4), n(3)}, {n(1), n(2), n(5), n(4)}};
  const Stars all(world(), whole);
  for (std::size_t i = 0; i < all.stars.size(); ++i)
    EXPECT_NEAR(all.star(i).worst_cost(all.part.point(NodeId{all.stars.nodes()[i]})), 0, 1e-15);
}

}  // namespace
}  // namespace quadloop::smoother
