// Cells beside the front of layers brought to the height of the last layer.
#include "smoother/fit_to_layers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "tests/smoother/whole_meshes.hpp"

namespace quadloop::smoother {
namespace {

using test::world;

constexpr double width = 0.125;

/// A grid in the square that is its outline. The first row of nodes is at `row` over the lower side.
struct LowRow {
  explicit LowRow(double row) {
    for (std::int32_t i = 10; i < 17; ++i) mesh.points[i].y = row;
  }
  Geometry square{{{"wall", 0, 30, "wall"}, {"far", 0, 30, "none"}},
                  {{0, 0}, {1, 0}, {1, 1}, {0, 1}},
                  {0, 4},
                  {BoundaryId{0}, BoundaryId{0}, BoundaryId{1}, BoundaryId{1}}};
  Mesh mesh = test::Grid{8, {1, 1}, true}.mesh();
};

struct Fitted {
  bool moved = false;
  std::map<std::int64_t, Point> positions;  ///< by the nodes' numbers
};

/// With a last layer of this height on the lower side, and a node that stays, if any.
Fitted fitted(const Communicator& comm, const LowRow& low, double height, std::int64_t stays = -1) {
  Mesh part = scatter_mesh(comm, low.mesh, own_order(low.mesh));
  HaloMesh halo(comm, part);
  const OutlinePath path(low.square);
  NodeFlags pinned(part.owned_nodes, 0);
  for (const NodeId node : pinned.ids()) pinned[node] = part.global(node).value() == stays ? 1 : 0;
  BoundarySlide slide(comm, halo, part.boundaries, &path, pinned);
  Fitted result;
  result.moved = fit_to_layers(comm, halo, slide, std::vector<double>{height, 0, 0, 0});
  for (const NodeId node : ids_below(NodeId{part.owned_nodes}))
    result.positions.emplace(part.global(node).value(), halo.point(node));
  return result;
}

/// Of the middle of the first row of nodes.
double height_of(const Fitted& fit) { return fit.positions.at(13).y; }

TEST(FitToLayers, LowCellsGetHigher) {
  const LowRow low(0.5 * width);
  const Fitted fit = fitted(test::self(), low, width);
  EXPECT_TRUE(fit.moved);
  EXPECT_GT(height_of(fit), 0.7 * width);
  for (std::int64_t i = 0; i < 9; ++i) EXPECT_EQ(fit.positions.at(i), low.mesh.points[i]) << "an even front";
  for (std::int64_t i = 54; i < 81; ++i) EXPECT_EQ(fit.positions.at(i), low.mesh.points[i]) << "far away";
}

TEST(FitToLayers, HighCellsGetLower) {
  const Fitted fit = fitted(test::self(), LowRow(1.3 * width), 0.5 * width);
  EXPECT_TRUE(fit.moved);
  EXPECT_LT(height_of(fit), 1.15 * width);
}

TEST(FitToLayers, CellsOfTheLayersHeightStay) {
  EXPECT_FALSE(fitted(test::self(), LowRow(0.8 * width), width).moved);
  EXPECT_FALSE(fitted(test::self(), LowRow(0.5 * width), 0).moved) << "no front";
}

TEST(FitToLayers, WhereWidthsJumpNodesSlideAndOthersFollow) {
  LowRow low(width);
  low.mesh.points[4].x += 0.4 * width;
  const Fitted fit = fitted(test::self(), low, width);
  EXPECT_TRUE(fit.moved);
  EXPECT_LT(fit.positions.at(4).x, low.mesh.points[4].x - 0.1 * width);
  EXPECT_EQ(fit.positions.at(4).y, 0);
}

/// Widths are even on either side of the node, so that no other one is uneven.
TEST(FitToLayers, WhereWidthsJumpAtANodeThatStaysItsNeighbourSlides) {
  LowRow low(width);
  constexpr double middle = 0.58;
  for (std::int32_t i = 1; i < 8; ++i)
    low.mesh.points[i].x = i <= 4 ? middle * i / 4 : middle + (1 - middle) * (i - 4) / 4;
  const Fitted fit = fitted(test::self(), low, width, 4);
  EXPECT_TRUE(fit.moved);
  EXPECT_EQ(fit.positions.at(4), low.mesh.points[4]);
  EXPECT_GT(fit.positions.at(3).x, low.mesh.points[3].x + 0.02 * width) << "towards the narrower side";
}

TEST(FitToLayers, IsTheSameOnAnyNumberOfRanks) {
  LowRow low(0.55 * width);
  low.mesh.points[4].x += 0.4 * width;
  const Fitted alone = fitted(test::self(), low, width), fit = fitted(world(), low, width);
  EXPECT_EQ(fit.moved, alone.moved) << "every rank knows";
  for (const auto& [node, p] : fit.positions) EXPECT_EQ(p, alone.positions.at(node)) << node;
}

}  // namespace
}  // namespace quadloop::smoother
