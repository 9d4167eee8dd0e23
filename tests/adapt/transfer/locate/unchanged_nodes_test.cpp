#include "adapt/transfer/locate/unchanged_nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/base/ids.hpp"
#include "tests/mesh/grid_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::adapt {
namespace {

using test::world;

/// Far apart and all different.
std::vector<Point> row_of_points(int count) {
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) points.push_back({static_cast<double>(i), 0.5});
  return points;
}

TEST(FindInOrder, WhatStandsIsFoundBesideWhatIsInsertedMovedAndSwapped) {
  const std::vector<Point> known = row_of_points(400);
  std::vector<Point> points = known;
  std::swap(points[100], points[110]);
  points[200].y = 7;
  points.insert(points.begin() + 300, 500, {-1, -1});
  const std::vector<std::int32_t> found = find_in_order(known, points);
  ASSERT_EQ(found.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto at = std::ranges::find(known, points[i]);
    EXPECT_EQ(found[i], at == known.end() ? -1 : at - known.begin()) << i;
  }
}

TEST(FindInOrder, AfterALongStretchIsGoneTheWayIsFoundAgain) {
  const std::vector<Point> known = row_of_points(1000);
  std::vector<Point> points(known.begin(), known.begin() + 100);
  points.insert(points.end(), known.begin() + 733, known.end());
  const std::vector<std::int32_t> found = find_in_order(known, points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_TRUE(found[i] == -1 || known[found[i]] == points[i]);
  }
  EXPECT_LT(std::ranges::count(found, -1), 33);
  EXPECT_TRUE(std::ranges::all_of(std::span(found).last(200), [](std::int32_t at) { return at >= 0; }));
}

TEST(FindInOrder, OfNothingNothingIsFound) {
  const std::vector<Point> points = row_of_points(5);
  EXPECT_EQ(find_in_order({}, points), std::vector<std::int32_t>(5, -1));
  EXPECT_TRUE(find_in_order(points, {}).empty());
}

/// Whether each owned node of a part finds itself; the files' boundaries may be missing.
std::vector<bool> stands(const Mesh& part) {
  const auto places = std::span(part.points).first(part.owned_nodes);
  std::vector<bool> found;
  for (const std::int32_t node : unchanged_nodes(part, inner_nodes(world(), part), places)) {
    EXPECT_TRUE(node == -1 || node == static_cast<std::int32_t>(found.size()));
    found.push_back(node >= 0);
  }
  return found;
}

TEST(StandingNodes, AreThoseWithinTheMeshWhateverTheRanksAndTheListedEdges) {
  for (const bool quads : {true, false}) {
    const test::Grid grid{16, {1, 1}, quads};
    Mesh whole = grid.mesh();
    whole.boundaries.clear();
    const Mesh part = scatter_mesh(world(), whole, test::shuffled_order(whole, 5));
    const std::vector<bool> found = stands(part);
    for (std::int32_t node = 0; node < part.owned_nodes; ++node) {
      const Point p = part.points[node];
      const bool inside = p.x > 0 && p.x < 1 && p.y > 0 && p.y < 1;
      EXPECT_EQ(found[node], inside) << p.x << " " << p.y;
    }
  }
}

TEST(StandingNodes, OfTwoAtOnePlaceNoneIsTaken) {
  Mesh mesh;  // two squares that touch in a corner which each of them has for itself
  mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1, 1}, {2, 1}, {2, 2}, {1, 2}};
  mesh.owned_nodes = size32(mesh.points);
  const auto quad = [](std::int32_t first) {
    return std::array{NodeId{first}, NodeId{first + 1}, NodeId{first + 2}, NodeId{first + 3}};
  };
  mesh.quads = {quad(0), quad(4)};
  const Communicator alone(MPI_COMM_SELF);
  const std::vector<std::int32_t> found = unchanged_nodes(mesh, inner_nodes(alone, mesh), mesh.points);
  EXPECT_EQ(found, std::vector<std::int32_t>(8, -1));
}

}  // namespace
}  // namespace quadloop::adapt
