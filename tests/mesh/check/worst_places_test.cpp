#include "mesher/mesh/check/worst_places.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop {
namespace {

using test::world;

// A unit square, beside it a triangle that is high and thin, above that a flat one.
Mesh uneven() {
  Mesh mesh;
  mesh.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {1.1, 0.5}, {3, 1.2}};
  mesh.owned_nodes = 6;
  const auto n = [](int i) { return NodeId{i}; };
  mesh.quads = {{n(0), n(1), n(2), n(3)}};
  mesh.triangles = {{n(1), n(4), n(2)}, {n(4), n(5), n(2)}};
  return mesh;
}

TEST(WorstPlaces, AreThoseOfTheWorstCells) {
  const Mesh whole = uneven();
  const WorstPlaces places = worst_places(world(), scatter_mesh(world(), whole, own_order(whole)), {});
  EXPECT_EQ(places.smallest_angle, (Point{1, 0}));     // 11.3 degrees, as at (1, 1), which comes later
  EXPECT_EQ(places.largest_angle, (Point{1.1, 0.5}));  // 157.4
  EXPECT_NEAR(places.worst_quality.x, 3.1 / 3, 1e-15);
  EXPECT_NEAR(places.worst_quality.y, 0.5, 1e-15);
}

TEST(WorstPlaces, OfEqualCellsTheFirst) {
  Mesh whole;  // squares side by side
  for (std::int32_t i = 0; i <= 12; ++i)
    whole.points.insert(whole.points.end(), {{1.0 * i, 0}, {1.0 * i, 1}});
  for (std::int32_t i = 0; i < 12; ++i)
    whole.quads.push_back({NodeId{2 * i}, NodeId{2 * i + 2}, NodeId{2 * i + 3}, NodeId{2 * i + 1}});
  whole.owned_nodes = size32(whole.points);
  std::ranges::reverse(whole.quads);
  const WorstPlaces places = worst_places(world(), scatter_mesh(world(), whole, own_order(whole)), {});
  EXPECT_EQ(places.smallest_angle, (Point{11, 0}));
  EXPECT_EQ(places.largest_angle, (Point{11, 0}));
  EXPECT_EQ(places.worst_quality, (Point{11.5, 0.5}));
}

}  // namespace
}  // namespace quadloop
