// Which edges give way, found on any number of ranks and held against a look at every edge of the whole mesh.
#include "mesher/delaunay/restore/wrong_edges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>

#include "mesher/base/ids.hpp"
#include "mesher/delaunay/flipper.hpp"
#include "mesher/mesh/topology.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

TieRank rank_of(Point p) { return {-1, -1, std::abs(p.x) + std::abs(p.y), std::abs(p.x), p.x, p.y}; }

/// A node is flagged by its number over all ranks.
using Flagged = bool (*)(GlobalNodeId);
bool all(GlobalNodeId) { return true; }
bool some(GlobalNodeId node) { return node.value() % 5 != 0; }
bool few(GlobalNodeId node) { return node.value() % 23 == 0; }

std::set<GlobalNodeId> expected(const Mesh& whole, Flagged named, Flagged moved) {
  std::set<GlobalNodeId> found;
  const EdgeTable table(whole);
  for_each_cell_edge(whole, [&](NodeId from, NodeId to, std::int32_t cell) {
    const std::int32_t other = table.cell_left_of(to, from);
    if (other < 0 || from > to) return;
    const auto apex = [&](std::int32_t t) {
      const auto& nodes = whole.triangles[t];
      return *std::find_if(nodes.begin(), nodes.end(), [&](NodeId n) { return n != from && n != to; });
    };
    const std::array four{from, to, apex(cell), apex(other)};
    const auto is_moved = [&](NodeId node) { return moved(whole.global(node)); };
    const auto rank = [&](std::size_t k) { return rank_of(whole.point(four[k])); };
    if (named(whole.global(from)) && named(whole.global(to)) &&
        std::any_of(four.begin(), four.end(), is_moved) &&
        should_flip(whole.point(four[0]), whole.point(four[1]), whole.point(four[2]), whole.point(four[3]),
                    rank))
      found.insert({whole.global(from), whole.global(to)});
  });
  return found;
}

std::set<GlobalNodeId> found(const Mesh& part, Flagged named, Flagged moved) {
  std::vector<GlobalNodeId> nodes;  // each named by its owner alone
  NodeFlags flags(part.points.size(), 0);
  for (const NodeId node : flags.ids()) {
    flags[node] = moved(part.global(node)) ? 1 : 0;
    if (part.owns(node) && named(part.global(node))) nodes.push_back(part.global(node));
  }
  const auto ends = nodes_of_wrong_edges(world(), part, nodes, moved == all ? NodeFlags{} : flags, rank_of);
  const auto of_all = world().all_gather_values(std::span<const GlobalNodeId>(ends));
  return {of_all.begin(), of_all.end()};
}

TEST(WrongEdges, AreThoseOfTheWholeMesh) {
  const test::Grid grid{12, {1, 1}, false};
  for (const double share : {0.0, 0.2}) {  // diagonals of squares, all of them ties; few ties
    Mesh whole = grid.mesh();
    test::jitter(grid, share, 3, whole);
    const Mesh part = scatter_mesh(world(), whole, space_filling_order(whole));
    const Communicator self(MPI_COMM_SELF);
    const Mesh same = scatter_mesh(self, whole, space_filling_order(whole));
    for (const Flagged named : {all, some}) {
      for (const Flagged moved : {all, few}) {
        const std::set<GlobalNodeId> ends = expected(same, named, moved);
        EXPECT_GT(ends.size(), 5U);
        EXPECT_EQ(found(part, named, moved), ends);
      }
    }
  }
}

}  // namespace
}  // namespace quadloop
