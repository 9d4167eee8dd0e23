// Delaunay meshes stay Delaunay when they are smoothed: the same on any number of ranks, never worse by
// flips, within their blocks.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "mesher/base/ids.hpp"
#include "mesher/delaunay/restore/restore_delaunay.hpp"
#include "mesher/mesh/check/delaunay_check.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/topology.hpp"
#include "smoother/objective/condition_number.hpp"
#include "tests/delaunay/rank_of.hpp"
#include "tests/smoother/rounding.hpp"
#include "tests/smoother/whole_meshes.hpp"

namespace quadloop::smoother {
namespace {

using test::degrees_rounding;
using test::expect_same_positions;
using test::Grid;
using test::jittered;
using test::rank_of;
using test::rounding;
using test::self;
using test::smooth_both_ways;
using test::smoothed_alone;
using test::world;

TEST(SmoothDelaunay, IsTheSameDelaunayMeshOnAnyNumberOfRanks) {
  Mesh mesh = jittered(Grid{12, {2, 1}, false}, 0.24);
  restore_delaunay(self(), mesh, NodeFlags(mesh.points.size(), 1), rank_of);
  SmoothOptions options;
  options.delaunay = rank_of;
  expect_same_positions(mesh, [&](const Mesh&) { return options; });
  const test::Smoothed s =
      smooth_both_ways(mesh, space_filling_order(mesh), [&](const Mesh&) { return options; });
  EXPECT_TRUE(is_delaunay(s.alone));
  auto own = s.part.triangles;
  for (auto& t : own) {
    for (NodeId& node : t) node = NodeId{static_cast<std::int32_t>(s.part.global(node).value())};
  }
  EXPECT_TRUE(world().all_gather_values(std::span<const std::array<NodeId, 3>>(own)) == s.alone.triangles);
}

/// The two halves of a grid's triangles, between them a line that follows sides and diagonals of its squares.
std::vector<std::int32_t> halves(const Mesh& whole) {
  std::vector<std::int32_t> blocks;
  for (const auto& t : whole.triangles)
    blocks.push_back(
        (1.0 / 3) * (whole.point(t[0]).x + whole.point(t[1]).x + whole.point(t[2]).x) < 1.07 ? 0 : 1);
  return blocks;
}

/// The edges that triangles of two blocks share.
std::vector<std::array<NodeId, 2>> interface_of(const Mesh& whole, const std::vector<std::int32_t>& blocks) {
  const EdgeTable table(whole);
  std::vector<std::array<NodeId, 2>> edges;
  for_each_cell_edge(whole, [&](NodeId from, NodeId to, std::int32_t cell) {
    const std::int32_t other = table.cell_left_of(to, from);
    if (other >= 0 && blocks[cell] == 0 && blocks[other] == 1) edges.push_back({from, to});
  });
  std::sort(edges.begin(), edges.end());
  return edges;
}

TEST(SmoothDelaunay, KeepsEdgesBetweenBlocksOfADelaunayMesh) {
  Mesh mesh = jittered(Grid{12, {2, 1}, false}, 0.24, 6);
  const std::vector<std::int32_t> blocks = halves(mesh);
  restore_delaunay(self(), mesh, NodeFlags(mesh.points.size(), 1), rank_of, blocks);
  const auto interface = interface_of(mesh, blocks);
  EXPECT_GE(interface.size(), 12U);
  ASSERT_TRUE(is_delaunay(mesh, blocks));
  EXPECT_FALSE(is_delaunay(mesh)) << "without blocks the interface would be flipped";
  std::vector<char> pinned(mesh.points.size(), 0);
  for (const auto& [from, to] : interface) pinned[from.value()] = pinned[to.value()] = 1;
  for (const MeshOrder& order : {space_filling_order(mesh), test::shuffled_order(mesh, 7)}) {
    Mesh smoothed[2] = {mesh, mesh};
    for (int all = 0; all < 2; ++all) {
      const Communicator& comm = all == 1 ? world() : self();
      Mesh part = scatter_mesh(comm, mesh, order);
      SmoothOptions options;
      options.delaunay = rank_of;
      options.pinned = NodeFlags{scatter_nodes(comm, pinned, order)};
      options.triangle_to_block = scatter_triangles(comm, blocks, order);
      EXPECT_GT(smooth_mesh(comm, part, options).moves, 0);
      gather_mesh(comm, part, order, smoothed[all]);
    }
    EXPECT_FALSE(smoothed[0].triangles == mesh.triangles);
    EXPECT_TRUE(is_delaunay(smoothed[0], blocks));
    EXPECT_TRUE(interface_of(smoothed[0], blocks) == interface) << "places have changed their blocks";
    EXPECT_TRUE(!world().is_root() ||
                (smoothed[0].points == smoothed[1].points && smoothed[0].triangles == smoothed[1].triangles));
  }
}

/// Beside a whole mesh of triangles, which stays Delaunay, small ones of nine nodes each: when NLopt moves
/// the five inner ones a little, the flips that follow leave a triangle worse than any before.
Mesh with_touchy_pieces(Mesh mesh, int pieces) {
  constexpr std::array<std::array<int, 3>, 10> triangles{{{8, 4, 7},
                                                          {0, 4, 1},
                                                          {5, 4, 8},
                                                          {4, 5, 1},
                                                          {4, 3, 7},
                                                          {3, 4, 0},
                                                          {6, 5, 8},
                                                          {5, 6, 1},
                                                          {3, 2, 7},
                                                          {2, 3, 0}}};
  constexpr std::array<std::array<int, 2>, 6> sides{{{0, 2}, {8, 6}, {1, 0}, {2, 7}, {6, 1}, {7, 8}}};
  for (int piece = 0; piece < pieces; ++piece) {
    const auto at = [first = mesh.points.size()](int k) {
      return NodeId{static_cast<std::int32_t>(first) + k};
    };
    const double left = 20.0 / 9, middle = 2.5, right = 40.0 / 9, y = 2 * (piece + 1);
    for (const Point p : {Point{left, 0},
                          {left, 1},
                          {middle, 0.25},
                          {middle, 0.375},
                          {middle, 0.5},
                          {middle, 0.625},
                          {middle, 0.75},
                          {right, 0},
                          {right, 1}}) {
      mesh.points.push_back({p.x, p.y + y});
    }
    for (const auto& t : triangles) mesh.triangles.push_back({at(t[0]), at(t[1]), at(t[2])});
    for (const auto& e : sides) mesh.boundaries[0].edges.push_back({at(e[0]), at(e[1])});
  }
  mesh.owned_nodes = size32(mesh.points);
  return mesh;
}

double worst_triangle(const Mesh& mesh) {
  double worst = 0;
  for (const auto& t : mesh.triangles)
    worst = std::max(
        worst, cell_cost<3>({mesh.point(t[0]), mesh.point(t[1]), mesh.point(t[2])}, ideal_targets<3>()));
  return worst;
}

TEST(SmoothDelaunay, NeverGetsWorseByFlips) {
  Mesh grid = jittered(Grid{6, {1, 1}, false}, 0.24);
  restore_delaunay(self(), grid, NodeFlags(grid.points.size(), 1), rank_of);
  for (int pieces = 1; pieces <= 5; ++pieces) {
    const Mesh mesh = with_touchy_pieces(grid, pieces);
    ASSERT_TRUE(is_delaunay(mesh));
    SmoothOptions options;
    options.delaunay = rank_of;
    options.method = Method::nlopt;
    for (options.sweeps = 1; options.sweeps <= 3; ++options.sweeps) {
      SmoothReport report;
      const Mesh after = smoothed_alone(mesh, options, &report);
      EXPECT_EQ(report.worst_cost_after, worst_triangle(after)) << "seen before the flips";
      EXPECT_LE(worst_triangle(after), worst_triangle(mesh) * (1 + rounding))
          << pieces << " pieces, " << options.sweeps << " sweeps";
      EXPECT_GE(summarise_quality(self(), after).smallest_degrees,
                summarise_quality(self(), mesh).smallest_degrees - degrees_rounding);
      EXPECT_TRUE(is_delaunay(after));
      EXPECT_FALSE(after.points == mesh.points) << "the grid is not to suffer for the rest";
    }
    expect_same_positions(mesh, [&](const Mesh&) { return options; });
  }
}

}  // namespace
}  // namespace quadloop::smoother
