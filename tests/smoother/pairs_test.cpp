// Periodic pairs: partners move together, as one node with the cells of both sides around it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesher/geometry/turn.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/check/validate.hpp"
#include "mesher/mesh/paired_nodes.hpp"
#include "smoother/movable_mesh.hpp"
#include "tests/smoother/rounding.hpp"
#include "tests/smoother/whole_meshes.hpp"

namespace quadloop::smoother {
namespace {

using test::degrees_rounding;
using test::Grid;
using test::self;
using test::smoothed_alone;

constexpr std::int32_t cells_across = 10;

/// A square of irregular cells with the sides "south", "east", "north" and "west", nodes equal on opposite
/// ones, and pairs in both directions.
Mesh torus(double share, std::uint64_t seed, double side = 1) {
  Mesh mesh = test::jittered(Grid{cells_across, {side, side}}, share, seed);
  std::vector<BoundaryEdges> sides;
  for (const char* name : {"south", "east", "north", "west"}) sides.push_back({name, {}, {}});
  const auto at = [&](std::int32_t column, std::int32_t row) {
    return NodeId{row * (cells_across + 1) + column};
  };
  for (std::int32_t i = 0; i <= cells_across; ++i) {
    mesh.points[at(i, cells_across).value()] = {mesh.point(at(i, 0)).x, side};
    mesh.points[at(cells_across, i).value()] = {side, mesh.point(at(0, i)).y};
  }
  for (std::int32_t i = 0; i < cells_across; ++i) {
    sides[0].edges.push_back({at(i, 0), at(i + 1, 0)});
    sides[1].edges.push_back({at(cells_across, i), at(cells_across, i + 1)});
    sides[2].edges.push_back({at(i + 1, cells_across), at(i, cells_across)});
    sides[3].edges.push_back({at(0, i + 1), at(0, i)});
  }
  mesh.boundaries = sides;
  mesh.pairs = {{"west", "east", {side, 0}}, {"south", "north", {0, side}}};
  return mesh;
}

/// A sector of a ring from the radius 1 to 2: "south" turned by 50 degrees is "north".
Mesh sector(double share, std::uint64_t seed) {
  Mesh mesh = torus(share, seed);
  for (Point& p : mesh.points) p = (1 + p.x) * unit_vector(p.y * 50);
  mesh.pairs = {{"south", "north", {}, 50, {}}};
  for (const auto& [from, to] : mesh.boundaries[0].edges)
    for (const NodeId node : {from, to})
      mesh.points[node.value() + cells_across * (cells_across + 1)] = mesh.pairs[0].image(mesh.point(node));
  return mesh;
}

/// The partners are images of each other, to the bit; ends stay, and many others have moved.
void expect_moved_together(const Mesh& before, const Mesh& after) {
  EXPECT_TRUE(validate(after).empty());
  for (const PeriodicPair& pair : after.pairs) {
    const PairedNodes nodes = paired_nodes(self(), after, pair);
    std::int32_t moved = 0;
    for (std::size_t i = 0; i < nodes.from.nodes.size(); ++i) {
      const NodeId from{static_cast<std::int32_t>(nodes.from.nodes[i].value())};
      EXPECT_EQ(pair.image(nodes.from.points[i]), nodes.to.points[i]) << pair.from << " " << i;
      moved += after.point(from) != before.point(from) ? 1 : 0;
    }
    EXPECT_EQ(nodes.from.points.front(), paired_nodes(self(), before, pair).from.points.front());
    EXPECT_EQ(nodes.to.points.back(), paired_nodes(self(), before, pair).to.points.back());
    EXPECT_GT(moved, cells_across / 3) << pair.from;
  }
}

TEST(SmoothPairs, PartnersMoveTogether) {
  for (std::uint64_t seed = 0; seed < 4; ++seed) {
    for (const Mesh& mesh : {torus(0.24, seed), sector(0.24, seed)})
      expect_moved_together(mesh, smoothed_alone(mesh, {}));
  }
}

TEST(SmoothPairs, BothPartnersTakeThePositionOfTheirNode) {
  Mesh mesh = torus(0.24, 1);
  const Mesh before = mesh;
  const PairedNodes nodes = paired_nodes(self(), mesh, mesh.pairs[0]);
  const auto at = [](GlobalNodeId node) { return NodeId{static_cast<std::int32_t>(node.value())}; };
  const NodeId from = at(nodes.from.nodes[3]), to = at(nodes.to.nodes[3]);
  MovableMesh movable(self(), mesh, {});
  const NodeId joined = movable.joined()->node_of[from];
  EXPECT_TRUE(movable.halo().owns(joined));
  EXPECT_FALSE(movable.halo().owns(movable.joined()->node_of[to]));
  movable.halo().points()[joined.value()].y += 0.01;
  movable.halo().update_points();
  const NodeFlags moved = movable.take_positions();
  EXPECT_EQ(mesh.point(from), (before.point(from) + Point{0, 0.01}));
  EXPECT_EQ(mesh.point(to), mesh.pairs[0].image(mesh.point(from)));
  for (const NodeId node : moved.ids()) EXPECT_EQ(moved[node] != 0, node == from || node == to);
  EXPECT_EQ(std::ranges::count(movable.take_positions(), 1), 0) << "since the last call";
}

TEST(SmoothPairs, AreTheSameOnAnyNumberOfRanks) {
  for (const Mesh& mesh : {torus(0.24, 1), sector(0.24, 2)})
    test::expect_same_positions(mesh, [](const Mesh&) { return SmoothOptions{}; });
}

/// The worst cell would become worse on one side if only the cells on the other one counted.
TEST(SmoothPairs, TheCellsOnBothSidesCount) {
  double free = 0, fixed = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    const Mesh mesh = torus(0.24, seed);
    SmoothOptions options;
    options.bad = 1;
    const double before = summarise_quality(self(), mesh).smallest_degrees;
    for (options.sweeps = 1; options.sweeps <= 3; ++options.sweeps)
      EXPECT_GE(summarise_quality(self(), smoothed_alone(mesh, options)).smallest_degrees,
                before - degrees_rounding);
    options = {};
    free += summarise_quality(self(), smoothed_alone(mesh, options)).smallest_degrees;
    options.pinned = NodeFlags(mesh.owned_nodes, 0);
    for (const NodeId node : nodes_on_sides(mesh)) options.pinned[node] = 1;
    fixed += summarise_quality(self(), smoothed_alone(mesh, options)).smallest_degrees;
  }
  EXPECT_GT(free, fixed + 12) << "degrees, sums over 12 meshes";
}

TEST(SmoothPairs, ANodeStaysIfItsPartnerIsPinned) {
  const Mesh mesh = torus(0.24, 1);
  SmoothOptions options;
  options.pinned = NodeFlags(mesh.owned_nodes, 0);
  const PairedNodes nodes = paired_nodes(self(), mesh, mesh.pairs[0]);
  for (const GlobalNodeId node : nodes.to.nodes)
    options.pinned[NodeId{static_cast<std::int32_t>(node.value())}] = 1;
  EXPECT_EQ(paired_nodes(self(), smoothed_alone(mesh, options), mesh.pairs[0]).from.points,
            nodes.from.points);
}

TEST(SmoothPairs, NodesStayWherePairsCannotBeJoined) {
  Mesh mesh = torus(0.24, 1);
  mesh.pairs = {{"west", "east", {1.5, 0}}};
  SmoothReport report;
  const Mesh after = smoothed_alone(mesh, {}, &report);
  EXPECT_GT(report.moves, 0);
  for (const NodeId node : nodes_on_sides(mesh)) EXPECT_EQ(after.point(node), mesh.point(node));
}

/// In a strip that is one cell wide each cell reaches from a node to its partner.
TEST(SmoothPairs, NodesBesideTheirOwnImagesStay) {
  Mesh mesh;
  const auto at = [](std::int32_t column, std::int32_t row) { return NodeId{2 * row + column}; };
  mesh.boundaries = {
      {"left", {}, {}}, {"right", {}, {}}, {"ends", {}, {{at(0, 0), at(1, 0)}, {at(1, 4), at(0, 4)}}}};
  for (const double y : {0.0, 0.2, 2.0, 2.3, 4.0}) mesh.points.insert(mesh.points.end(), {{0, y}, {1, y}});
  mesh.owned_nodes = size32(mesh.points);
  for (std::int32_t row = 0; row < 4; ++row) {
    mesh.triangles.push_back({at(0, row), at(1, row), at(1, row + 1)});
    mesh.triangles.push_back({at(0, row), at(1, row + 1), at(0, row + 1)});
    mesh.boundaries[0].edges.push_back({at(0, row + 1), at(0, row)});
    mesh.boundaries[1].edges.push_back({at(1, row), at(1, row + 1)});
  }
  mesh.pairs = {{"left", "right", {1, 0}}};
  EXPECT_EQ(smoothed_alone(mesh, {}).points, mesh.points);
}

TEST(SmoothPairs, TheUnitOfLengthDoesNotMatter) {
  const Mesh small = torus(0.24, 1), large = torus(0.24, 1, 0x1p230);
  const Mesh after = smoothed_alone(small, {}), after_large = smoothed_alone(large, {});
  expect_moved_together(large, after_large);
  for (const NodeId node : ids_below(NodeId{small.owned_nodes}))
    EXPECT_EQ(0x1p230 * after.point(node), after_large.point(node));
}

}  // namespace
}  // namespace quadloop::smoother
