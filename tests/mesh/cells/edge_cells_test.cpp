// The cells on both sides of each edge, on any number of ranks as on one.
#include "mesher/mesh/cells/edge_cells.hpp"

#include <gtest/gtest.h>

#include <map>

#include "mesher/mesh/scatter_mesh.hpp"
#include "mesher/mesh/topology.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using Edge = std::pair<std::int64_t, std::int64_t>;

TEST(EdgeCells, AreThoseOfTheWholeMesh) {
  const Mesh whole = test::Grid{7}.mesh();
  const Communicator& comm = test::world();
  const Mesh part = scatter_mesh(comm, whole, comm.is_root() ? own_order(whole) : MeshOrder{});
  std::map<Edge, std::int64_t> left_of;
  for_each_cell_edge(whole, [&](NodeId from, NodeId to, std::int32_t cell) {
    left_of[{from.value(), to.value()}] = cell;
  });
  const auto left = [&](std::int64_t from, std::int64_t to) {
    const auto found = left_of.find({from, to});
    return found == left_of.end() ? EdgeCells::none : found->second;
  };
  const EdgeCells cells = edge_cells(comm, part);
  std::size_t at = 0;
  for_each_cell_edge(part, [&](NodeId from, NodeId to, std::int32_t) {
    EXPECT_EQ(cells.across[at++], left(part.global(to).value(), part.global(from).value()));
  });
  EXPECT_EQ(at, cells.across.size());
  at = 0;
  for (const BoundaryEdges& boundary : part.boundaries) {
    for (const auto& [from, to] : boundary.edges)
      EXPECT_EQ(cells.of_boundary[at++], left(part.global(from).value(), part.global(to).value()));
  }
  EXPECT_EQ(at, cells.of_boundary.size());
}

}  // namespace
}  // namespace quadloop
