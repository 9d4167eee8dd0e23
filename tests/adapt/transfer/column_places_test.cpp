// In layers a new node is asked for at its own height above the old wall, whose chords are others.
#include "adapt/transfer/column_places.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "adapt/transfer/transfer.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/mesh/layered_strip.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;

/// Layers on a parabola over [0, 6], with so many columns.
Mesh bent(std::int32_t columns, std::int32_t layers = 3) {
  test::LayeredStrip strip;
  strip.columns = columns;
  strip.layers = layers;
  strip.from = 0;
  Mesh mesh = strip.mesh();
  for (Point& p : mesh.points) {
    p.x *= 6.0 / columns;
    p.y += 0.1 * (p.x - 3) * (p.x - 3);
  }
  return mesh;
}

/// Above the wall of `bent(columns)`, in the direction of y: linear in each of its cells.
double height(Point p, std::int32_t columns) {
  const double width = 6.0 / columns, left = std::floor(p.x / width) * width;
  const auto wall = [](double x) { return 0.1 * (x - 3) * (x - 3); };
  return p.y - (wall(left) + (p.x - left) / width * (wall(left + width) - wall(left)));
}

Field heights_of(const Mesh& mesh, std::int32_t columns) {
  Field field{{"height"}, {}, {}};
  for (std::int32_t i = 0; i < mesh.owned_nodes; ++i) field.values.push_back(height(mesh.points[i], columns));
  return field;
}

TEST(ColumnPlaces, LayersKeepTheirHeightsThoughChordsDiffer) {
  const Mesh old_whole = bent(6), new_whole = bent(12);
  const Mesh old_mesh = scatter_mesh(world(), old_whole, test::shuffled_order(old_whole, 3));
  const Mesh new_mesh = scatter_mesh(world(), new_whole, test::shuffled_order(new_whole, 4));
  const Field transferred = transfer(world(), old_mesh, heights_of(old_mesh, 6), new_mesh).field;
  std::int64_t compared = 0;
  for (std::int32_t i = 0; i < new_mesh.owned_nodes; ++i) {
    const Point p = new_mesh.points[i];
    if (std::abs(p.x - 3) > 0.6 || p.x == 3) continue;  // half way along chords, 0.025 below them
    const double wanted = height(p, 12);
    if (wanted > 0.2) continue;
    EXPECT_NEAR(transferred.values[i], wanted, 0.005) << "not 0.025 more or less, at " << p.x << ", " << p.y;
    ++compared;
  }
  EXPECT_GE(world().sum(compared), 4) << "two nodes in each of two columns";
}

TEST(ColumnPlaces, NodesOutsideLayersAndThoseOfTheSameWallStay) {
  const Mesh old_mesh = bent(6), same = bent(6);
  const Communicator self(MPI_COMM_SELF);
  EXPECT_EQ(column_places(self, old_mesh, same), same.points);
  const Mesh finer = bent(12);
  const std::vector<Point> places = column_places(self, old_mesh, finer);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (height(finer.points[i], 12) > 0.7 - 1e-9) {
      EXPECT_EQ(places[i], finer.points[i]);
    }
    moved += places[i] == finer.points[i] ? 0 : 1;
  }
  EXPECT_GE(moved, 3U * 6U);
}

TEST(ColumnPlaces, NodesOfStripsStay) {
  const Mesh old_mesh = bent(6);
  Mesh finer = bent(12);
  const auto node = [](std::int32_t i, std::int32_t j) { return NodeId{13 * j + i}; };
  StripLayers strip{"wake", {1, 1}, false, 3, {}};
  for (std::int32_t i = 3; i <= 9; ++i) {
    for (std::int32_t j = 0; j <= 2; ++j) strip.nodes.push_back(finer.global(node(i, j)));
  }
  finer.strips = {strip};
  const std::vector<Point> places = column_places(Communicator(MPI_COMM_SELF), old_mesh, finer);
  for (const GlobalNodeId listed : strip.nodes)
    EXPECT_EQ(places[listed.value()], finer.points[listed.value()]);
  EXPECT_NE(places[node(1, 1).value()], finer.point(node(1, 1))) << "in the wall's layers";
}

TEST(ColumnPlaces, AreTheSameOnAnyNumberOfRanks) {
  const Communicator self(MPI_COMM_SELF);
  const Mesh old_whole = bent(6), new_whole = bent(10);
  const MeshOrder order = test::shuffled_order(new_whole, 7);
  const Mesh old_mesh = scatter_mesh(world(), old_whole, test::shuffled_order(old_whole, 5));
  const std::vector<Point> alone = column_places(self, old_whole, scatter_mesh(self, new_whole, order));
  const std::vector<Point> mine = column_places(world(), old_mesh, scatter_mesh(world(), new_whole, order));
  EXPECT_EQ(world().all_gather_values(std::span<const Point>(mine)), alone);
}

TEST(ColumnPlaces, WithoutLayersNothingMoves) {
  Mesh old_mesh = bent(6);
  const Mesh finer = bent(12);
  for (BoundaryEdges& b : old_mesh.boundaries) b.layers = {};
  EXPECT_EQ(column_places(Communicator(MPI_COMM_SELF), old_mesh, finer), finer.points);
}

}  // namespace
}  // namespace quadloop::adapt
