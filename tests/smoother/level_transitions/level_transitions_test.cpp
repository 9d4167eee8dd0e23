// Lines where squares of two sizes meet move as a whole: better corners at hanging nodes, and parallelograms
// beside them.
#include "smoother/level_transitions/level_transitions.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/base/ids.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/smoother/level_transitions/turns.hpp"
#include "tests/support/world.hpp"

namespace quadloop::smoother {
namespace {

using test::on_its_side;
using test::upright;
using test::upside_down;
using test::world;

constexpr std::int32_t coarse = 6;  ///< squares of edge 1 in a row
constexpr double no_limit = 1, tight = 1e-9;

/// From below: two rows of squares of edge 1/2, a row of unit squares divided at the hanging nodes of their
/// lower sides, a row of unit squares. `place` turns it round.
template <class Place>
Mesh two_levels(const Place& place) {
  Mesh mesh;
  const auto add_row = [&](std::int32_t steps, double y) {
    for (std::int32_t i = 0; i <= steps; ++i)
      mesh.points.push_back(place(Point{static_cast<double>(i * coarse) / steps, y}));
    return size32(mesh.points) - steps - 1;
  };
  const std::array<std::int32_t, 5> rows{add_row(2 * coarse, 0), add_row(2 * coarse, 0.5),
                                         add_row(2 * coarse, 1), add_row(coarse, 2), add_row(coarse, 3)};
  const auto node = [&](std::size_t row, std::int32_t i) { return NodeId{rows[row] + i}; };
  for (const std::size_t row : {0U, 1U, 3U}) {
    for (std::int32_t i = 0; i < (row == 3 ? 1 : 2) * coarse; ++i) {
      mesh.quads.push_back({node(row, i), node(row, i + 1), node(row + 1, i + 1), node(row + 1, i)});
    }
  }
  for (std::int32_t i = 0; i < coarse; ++i) {
    const NodeId left = node(2, 2 * i), hanging = node(2, 2 * i + 1), right = node(2, 2 * i + 2),
                 top_left = node(3, i), top_right = node(3, i + 1);
    mesh.triangles.insert(
        mesh.triangles.end(),
        {{left, hanging, top_left}, {hanging, right, top_right}, {hanging, top_right, top_left}});
  }
  mesh.boundaries = {{"rim", "wall", {}}};
  auto& edges = mesh.boundaries[0].edges;
  for (std::int32_t i = 0; i < 2 * coarse; ++i) edges.push_back({node(0, i), node(0, i + 1)});
  for (std::int32_t i = 0; i < coarse; ++i) edges.push_back({node(4, i + 1), node(4, i)});
  for (std::size_t row = 0; row < 4; ++row) {
    edges.push_back({node(row + 1, 0), node(row, 0)});
    edges.push_back(
        {node(row, row < 3 ? 2 * coarse : coarse), node(row + 1, row + 1 < 3 ? 2 * coarse : coarse)});
  }
  mesh.owned_nodes = size32(mesh.points);
  return mesh;
}

/// This rank's part with its lines moved.
Mesh with_lines_moved(const Mesh& whole, const MeshOrder& order, const std::vector<char>& pinned = {},
                      double limit = no_limit) {
  Mesh part = scatter_mesh(world(), whole, order);
  HaloMesh halo(world(), part);
  move_square_lines(world(), halo, NodeFlags{scatter_nodes(world(), pinned, order)}, limit);
  std::copy_n(halo.points().begin(), part.points.size(), part.points.begin());
  return part;
}

std::int64_t count_skew(const Mesh& part) {
  return world().sum(std::count_if(part.quads.begin(), part.quads.end(), [&](const auto& q) {
    return !(skew_of({part.point(q[0]), part.point(q[1]), part.point(q[2]), part.point(q[3])}) <=
             parallel_skew);
  }));
}

TEST(LevelTransitions, LiftTheSmallestAngleAndKeepParallelograms) {
  for (const auto place : {upright, on_its_side, upside_down}) {
    const Mesh whole = two_levels(place);
    for (const MeshOrder& order : {space_filling_order(whole), test::shuffled_order(whole, 4)}) {
      const Mesh before = scatter_mesh(world(), whole, order), after = with_lines_moved(whole, order);
      EXPECT_NEAR(summarise_quality(world(), before).smallest_degrees, 26.565, 1e-3);
      EXPECT_NEAR(summarise_quality(world(), after).smallest_degrees, 29.745, 1e-3);  // atan(0.5 / 0.875)
      EXPECT_EQ(count_skew(after), 2);  // at the ends: nodes of the rim stay
    }
  }
}

TEST(LevelTransitions, MoveTheNodesOfTheLineAlone) {
  const Mesh whole = two_levels(upright);
  const Mesh after = with_lines_moved(whole, space_filling_order(whole));
  std::int64_t moved = 0;
  const Mesh before = scatter_mesh(world(), whole, space_filling_order(whole));
  for (std::size_t n = 0; n < before.points.size(); ++n) {
    const Point from = before.points[n], to = after.points[n];
    const bool on_line = from.y == 1 && from.x > 0 && from.x < coarse;
    EXPECT_EQ(to, on_line ? from + Point(0, 0.125) : from);
    moved += static_cast<std::int32_t>(n) < before.owned_nodes && from != to ? 1 : 0;
  }
  EXPECT_EQ(world().sum(moved), 2 * coarse - 1);
}

TEST(LevelTransitions, LeavePinnedNodes) {
  const Mesh whole = two_levels(upright);
  const MeshOrder order = space_filling_order(whole);
  const Mesh after = with_lines_moved(whole, order, std::vector<char>(whole.points.size(), 1));
  EXPECT_EQ(count_skew(after), 0);
  EXPECT_NEAR(summarise_quality(world(), after).smallest_degrees, 26.565, 1e-3);
}

TEST(LevelTransitions, LeaveCellsThatWouldCostTooMuch) {
  const Mesh whole = two_levels(upright);  // the rectangles cost a little
  EXPECT_EQ(count_skew(with_lines_moved(whole, space_filling_order(whole), {}, tight)), 0);
}

TEST(LevelTransitions, LeaveSquaresWithoutHangingNodes) {
  test::Grid grid{6};
  Mesh mesh = grid.mesh();  // squares and halved squares
  const MeshOrder order = space_filling_order(mesh);
  const Mesh before = scatter_mesh(world(), mesh, order);
  EXPECT_EQ(with_lines_moved(mesh, order).points, before.points);
}

}  // namespace
}  // namespace quadloop::smoother
