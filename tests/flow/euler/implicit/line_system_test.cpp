// Lines through thin cells: found alike on any number of ranks, solved as a dense system would be.
#include "flow/euler/implicit/line_system.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <map>
#include <set>

#include "tests/flow/euler/flow_meshes.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::flow::euler {
namespace {

using test::world;

constexpr std::int32_t n = 7;

/// Cells a hundred times as wide as high, numbered anew so that ranks share the lines.
Mesh thin_cells(const Communicator& comm) {
  const Mesh whole = test::irregular_grid(n, {1, 0.01}, 0.1);
  return scatter_mesh(comm, whole, test::shuffled_order(whole, 3));
}

TEST(FindLines, CrossThinCellsFromSideToSide) {
  const Mesh mesh = thin_cells(world());
  const DualMesh dual(world(), mesh);
  const std::vector<NodeLine> lines = find_lines(world(), dual, colour_dual_nodes(world(), dual));
  const Communicator self(MPI_COMM_SELF);
  const Mesh all = thin_cells(self);
  const DualMesh whole(self, all);
  const std::vector<NodeLine> known = find_lines(self, whole, colour_dual_nodes(self, whole));
  ASSERT_EQ(known.size(), n + 1);
  std::map<GlobalNodeId, const NodeLine*> line_of;
  for (const NodeLine& line : known) {
    ASSERT_EQ(line.nodes.size(), n + 1);
    for (std::size_t k = 0; k < line.nodes.size(); ++k) {
      line_of[line.nodes[k]] = &line;
      const Point p = whole.point(NodeId{static_cast<std::int32_t>(line.nodes[k].value())});
      const double upwards = static_cast<double>(k) / n, place = p.y / 0.01;
      EXPECT_LT(std::min(std::abs(place - upwards), std::abs(1 - place - upwards)), 0.1);
    }
  }
  EXPECT_EQ(line_of.size(), (n + 1) * (n + 1));
  std::set<GlobalNodeId> here;
  for (const NodeLine& line : lines) {
    here.insert(line.nodes.begin(), line.nodes.end());
    EXPECT_EQ(line.nodes, line_of[line.nodes[0]]->nodes);
    EXPECT_EQ(line.colour, line_of[line.nodes[0]]->colour);
  }
  for (const NodeId node : dual.owned_ids()) EXPECT_TRUE(here.contains(dual.global(node)));
}

TEST(FindLines, AreNoneInCellsOfModerateShape) {
  const Mesh whole = test::irregular_grid(9, {1, 0.5}, 0.24);
  const Mesh mesh = scatter_mesh(world(), whole, space_filling_order(whole));
  const DualMesh dual(world(), mesh);
  EXPECT_TRUE(find_lines(world(), dual, colour_dual_nodes(world(), dual)).empty());
  EXPECT_TRUE(LineSystem(world(), dual, colour_dual_nodes(world(), dual)).empty());
}

TEST(FindLines, BeginWhereCellsAreThinnest) {
  const Communicator self(MPI_COMM_SELF);
  Mesh whole = test::irregular_grid(12, {1, 1}, 0.05);
  for (Point& p : whole.points) p.y = p.y * p.y * p.y * p.y;
  const Mesh mesh = scatter_mesh(self, whole, test::shuffled_order(whole, 3));
  const DualMesh dual(self, mesh);
  const std::vector<NodeLine> lines = find_lines(self, dual, colour_dual_nodes(self, dual));
  EXPECT_EQ(lines.size(), 13);
  for (const NodeLine& line : lines) {
    EXPECT_EQ(dual.point(NodeId{static_cast<std::int32_t>(line.nodes.front().value())}).y, 0);
    EXPECT_LT(dual.point(NodeId{static_cast<std::int32_t>(line.nodes.back().value())}).y, 0.5);
  }
}

TEST(FindLines, CutARing) {
  Mesh whole = test::ring_mesh(12, 2, 1, 4000);  // cells so long outwards that the rings are lines
  const Mesh mesh = scatter_mesh(world(), whole, test::shuffled_order(whole, 3));
  const DualMesh dual(world(), mesh);
  for (const NodeLine& line : find_lines(world(), dual, colour_dual_nodes(world(), dual))) {
    const std::set<GlobalNodeId> once(line.nodes.begin(), line.nodes.end());
    EXPECT_EQ(line.nodes.size(), 12);
    EXPECT_EQ(once.size(), 12);
    EXPECT_EQ(line.nodes[0], *once.begin());
  }
}

Matrix4 made_up_block(std::int64_t row, std::int64_t column) {
  Matrix4 block;
  for (std::size_t k = 0; k < 16; ++k)
    block[k] =
        test::scattered(1000 + row, column, static_cast<int>(k)) + (row == column && k % 5 == 0 ? 6 : 0);
  return block;
}

TEST(LineSystem, SolvesEachLineAsADenseSystem) {
  const Mesh mesh = thin_cells(world());
  const DualMesh dual(world(), mesh);
  const Colouring colours = colour_dual_nodes(world(), dual);
  LineSystem system(world(), dual, colours);
  ASSERT_FALSE(system.empty());
  IdVector<NodeId, Matrix4> diagonal(dual.nodes());
  std::vector<LineSystem::Row> rows(system.rows());
  for (const NodeId node : dual.owned_ids()) {
    const std::int64_t number = dual.global(node).value();
    diagonal[node] = made_up_block(number, number);
    for (std::size_t k = 0; k < 4; ++k)
      rows[node.value()][k] = test::scattered(5, number, static_cast<int>(k));
    for (const NodeId other : {system.links(node).before, system.links(node).after}) {
      if (other.valid()) system.set_block(node, other, made_up_block(number, dual.global(other).value()));
    }
  }
  system.factor(diagonal);
  for (int colour = 0; colour < colours.count; ++colour) system.solve(colour, rows);
  for (const NodeLine& line : find_lines(world(), dual, colours)) {
    const auto count = static_cast<std::int64_t>(line.nodes.size());
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(4 * count, 4 * count);
    Eigen::VectorXd right(4 * count);
    for (std::int64_t i = 0; i < count; ++i) {
      for (std::int64_t k = 0; k < 4; ++k)
        right[4 * i + k] = test::scattered(5, line.nodes[i].value(), static_cast<int>(k));
      for (std::int64_t j = std::max<std::int64_t>(0, i - 1); j < std::min(count, i + 2); ++j) {
        const Matrix4 block = made_up_block(line.nodes[i].value(), line.nodes[j].value());
        for (std::int64_t k = 0; k < 16; ++k) dense(4 * i + k / 4, 4 * j + k % 4) = block[k];
      }
    }
    const Eigen::VectorXd exact = dense.partialPivLu().solve(right);
    for (std::int64_t i = 0; i < count; ++i) {
      for (const NodeId node : dual.owned_ids()) {
        if (dual.global(node) != line.nodes[i]) continue;
        for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(rows[node.value()][k], exact[4 * i + k], 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace quadloop::flow::euler
