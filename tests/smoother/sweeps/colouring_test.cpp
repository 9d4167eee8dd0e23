// No two nodes that share a cell have one colour, and colours do not depend on the number of ranks.
#include "smoother/sweeps/colouring.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::smoother {
namespace {

using test::world;

/// The colours of a mesh's free nodes, on this communicator's share of it.
struct Coloured {
  Coloured(const Communicator& comm, const Mesh& whole, const MeshOrder& order,
           const std::vector<char>& is_free)
      : part{scatter_mesh(comm, whole, order)},
        halo(comm, part),
        colouring{colour_stars(comm, halo, NodeStars(halo, free_nodes(order, is_free), {}))} {}

  std::vector<NodeId> free_nodes(const MeshOrder& order, const std::vector<char>& is_free) const {
    std::vector<NodeId> nodes;
    for (const NodeId node : ids_below(NodeId{part.owned_nodes})) {
      if (is_free[order.nodes[part.global(node).value()]] != 0) nodes.push_back(node);
    }
    return nodes;
  }
  std::int8_t colour(NodeId node) const { return colouring.colour_of[node]; }

  Mesh part;
  HaloMesh halo;
  Colouring colouring;
};

/// Of the nodes inside a grid all, or some.
std::vector<char> free_inside(const test::Grid& grid, double share) {
  std::vector<char> flags;
  for (std::int32_t node = 0; node < (grid.n + 1) * (grid.n + 1); ++node) {
    flags.push_back(grid.inner(node) && test::scattered(8, node, 0) < 2 * share - 1 ? 1 : 0);
  }
  return flags;
}

void expect_sound(const Coloured& coloured) {
  coloured.halo.for_each_cell([&](const auto& nodes) {
    for (const NodeId a : nodes) {
      for (const NodeId b : nodes) {
        const std::int8_t colour = coloured.colour(a);
        EXPECT_LT(colour, coloured.colouring.count);
        if (a != b && colour != Colouring::none) {
          EXPECT_NE(colour, coloured.colour(b))
              << coloured.halo.global(a).value() << " and " << coloured.halo.global(b).value();
        }
      }
    }
  });
}

void expect_coloured_alike(const test::Grid& grid, const MeshOrder& order, double share) {
  const Mesh whole = grid.mesh();
  const std::vector<char> is_free = free_inside(grid, share);
  const Communicator self(MPI_COMM_SELF);
  const Coloured alone(self, whole, order, is_free), together(world(), whole, order, is_free);
  expect_sound(together);
  EXPECT_EQ(together.colouring.count, alone.colouring.count);
  ASSERT_EQ(together.colouring.colour_of.size(), together.halo.points().size());
  for (const NodeId node : together.colouring.colour_of.ids()) {
    const std::int64_t number = together.halo.global(node).value();
    EXPECT_EQ(together.colour(node), alone.colour(NodeId{static_cast<std::int32_t>(number)}));
    const bool is_none = together.colour(node) == Colouring::none;
    EXPECT_EQ(is_none, is_free[order.nodes[number]] == 0);
  }
}

TEST(Colouring, IsSoundAndTheSameOnAnyNumberOfRanks) {
  for (const bool quads : {true, false}) {
    const test::Grid grid{14, {1, 1}, quads};
    for (const double share : {1.0, 0.4}) {
      expect_coloured_alike(grid, space_filling_order(grid.mesh()), share);
      expect_coloured_alike(grid, test::shuffled_order(grid.mesh(), 6), share);
    }
  }
}

TEST(Colouring, NeedsFewColours) {
  const test::Grid grid{30};
  const Coloured coloured(world(), grid.mesh(), space_filling_order(grid.mesh()), free_inside(grid, 1));
  EXPECT_GE(coloured.colouring.count, 4);
  EXPECT_LE(coloured.colouring.count, 9);  // each node has at most eight neighbours
}

/// In an order that does not follow the numbers, but in blocks of 64 of them does.
TEST(Colouring, NodesChooseBlockByBlock) {
  const test::Grid grid{30};
  const Coloured coloured(world(), grid.mesh(), space_filling_order(grid.mesh()), free_inside(grid, 1));
  const auto owned = ids_below(NodeId{coloured.part.owned_nodes});
  const std::vector<NodeId> nodes(owned.begin(), owned.end());
  for (const int bits : {0, 6}) {
    const auto priority = [&](std::size_t i) {
      return ColouringPriority(coloured.halo.global(nodes[i]), bits);
    };
    const std::vector<std::int32_t> order = order_of_choice(coloured.halo, nodes, bits);
    std::vector<std::int32_t> indices = order;
    std::sort(indices.begin(), indices.end());
    ASSERT_EQ(order.size(), nodes.size());
    int steps = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
      EXPECT_EQ(indices[k], std::int32_t(k));
      if (k == 0) continue;
      EXPECT_GT(priority(order[k - 1]), priority(order[k]));
      steps += order[k] + 1 == order[k - 1] ? 1 : 0;
    }
    if (nodes.size() < 2) continue;
    EXPECT_EQ(bits > 0, 2 * steps > size32(order));
  }
}

TEST(Colouring, OfNothing) {
  const test::Grid grid{1};
  const Coloured coloured(world(), grid.mesh(), space_filling_order(grid.mesh()), free_inside(grid, 1));
  EXPECT_EQ(coloured.colouring.count, 0);
}

}  // namespace
}  // namespace quadloop::smoother
