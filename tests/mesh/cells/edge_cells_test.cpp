// The cells on both sides of each edge, on any number of ranks as on one.
#include "mesher/mesh/cells/edge_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesher/base/parallel/exchange.hpp"
#include "mesher/mesh/cells/block_part.hpp"
#include "mesher/mesh/topology.hpp"
#include "tests/mesh/two_blocks.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using Edge = std::pair<std::int64_t, std::int64_t>;

/// Returns this rank's number of a node, which becomes a ghost if it is none yet.
NodeId local_node(Mesh& mesh, std::int64_t global, Point place) {
  const std::int64_t owned = global - mesh.first_node;
  if (owned >= 0 && owned < mesh.owned_nodes) return NodeId{static_cast<std::int32_t>(owned)};
  const auto found = std::ranges::find(mesh.ghosts, GlobalNodeId{global});
  const auto ghost = static_cast<std::int32_t>(found - mesh.ghosts.begin());
  if (found == mesh.ghosts.end()) {
    mesh.ghosts.push_back(GlobalNodeId{global});
    mesh.points.push_back(place);
  }
  return NodeId{mesh.owned_nodes + ghost};
}

/// Moves the boundary edges of each rank to the next one. *Collective.*
void move_edges_on(const Communicator& comm, Mesh& mesh) {
  struct Moved {
    std::array<std::int64_t, 2> ends;
    std::array<Point, 2> places;
  };
  for (BoundaryEdges& boundary : mesh.boundaries) {
    Outbox<Moved> out;
    for (const auto& [from, to] : boundary.edges)
      out.add((comm.rank() + 1) % comm.size(),
              {{mesh.global(from).value(), mesh.global(to).value()}, {mesh.point(from), mesh.point(to)}});
    boundary.edges.clear();
    for (const Moved& edge : out.deliver(comm))
      boundary.edges.push_back(
          {local_node(mesh, edge.ends[0], edge.places[0]), local_node(mesh, edge.ends[1], edge.places[1])});
  }
}

/// The cell to the left of each directed edge of a whole mesh.
class LeftCells {
 public:
  explicit LeftCells(const Mesh& whole) {
    for_each_cell_edge(whole, [&](NodeId from, NodeId to, std::int32_t cell) {
      left_of_[{from.value(), to.value()}] = cell;
    });
  }
  std::int64_t of(GlobalNodeId from, GlobalNodeId to) const {
    const auto found = left_of_.find({from.value(), to.value()});
    return found == left_of_.end() ? EdgeCells::none : found->second;
  }

 private:
  std::map<Edge, std::int64_t> left_of_;
};

void expect_cells_of(const LeftCells& left, const Mesh& part) {
  const EdgeCells cells = edge_cells(test::world(), part);
  const std::vector<std::int64_t> right = cells_right_of_boundaries(test::world(), part);
  std::size_t at = 0;
  for_each_cell_edge(part, [&](NodeId from, NodeId to, std::int32_t) {
    EXPECT_EQ(cells.across[at++], left.of(part.global(to), part.global(from)));
  });
  EXPECT_EQ(at, cells.across.size());
  at = 0;
  for (const BoundaryEdges& boundary : part.boundaries) {
    for (const auto& [from, to] : boundary.edges) {
      EXPECT_EQ(cells.of_boundary[at], left.of(part.global(from), part.global(to))) << boundary.name;
      EXPECT_EQ(right[at++], left.of(part.global(to), part.global(from))) << boundary.name;
    }
  }
  EXPECT_EQ(at, cells.of_boundary.size());
  EXPECT_EQ(at, right.size());
}

/// Also of edges on a rank that has neither of their cells.
TEST(EdgeCells, AreThoseOfTheWholeMesh) {
  const Mesh whole = test::two_blocks(test::Grid{8, {2, 1}});
  Mesh part = test::part_with_blocks(test::world(), whole, own_order(whole));
  const LeftCells left(whole);
  for (int moves = 0; moves < test::world().size(); ++moves) {
    SCOPED_TRACE(moves);
    expect_cells_of(left, part);
    move_edges_on(test::world(), part);
  }
}

/// The parts do not depend on the ranks that store the edges.
TEST(BlockParts, HaveTheirEdgesFromAnyRank) {
  const Mesh whole = test::two_blocks(test::Grid{8, {2, 1}});
  Mesh mesh = test::part_with_blocks(test::world(), whole, own_order(whole));
  for (int moves = 0; moves < test::world().size(); ++moves) {
    for (const BlockPart& part : block_parts(test::world(), mesh)) {
      std::map<std::string, std::int64_t> edges;
      for (const BoundaryEdges& boundary : part.mesh.boundaries)
        edges[boundary.name] = test::world().sum(std::ssize(boundary.edges));
      EXPECT_EQ(edges["between"], 8);
      EXPECT_EQ(edges["wall"] + edges["far"], 16);
    }
    move_edges_on(test::world(), mesh);
  }
}

}  // namespace
}  // namespace quadloop
