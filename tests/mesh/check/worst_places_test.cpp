#include "mesher/mesh/check/worst_places.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace quadloop {
namespace {

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
  const Mesh mesh = uneven();
  const WorstPlaces places = worst_places(mesh, MeshTopology(mesh), {});
  EXPECT_EQ(places.smallest_angle, (Point{1, 0}));     // 11.3 degrees, as at (1, 1), which comes later
  EXPECT_EQ(places.largest_angle, (Point{1.1, 0.5}));  // 157.4
  EXPECT_NEAR(places.worst_quality.x, 3.1 / 3, 1e-15);
  EXPECT_NEAR(places.worst_quality.y, 0.5, 1e-15);
  EXPECT_EQ(places.largest_area_ratio, (Point{1, 0.5}));  // 1 by 0.05
}

TEST(WorstPlaces, OfACellWithoutAreaIsItsEdge) {
  Mesh mesh = uneven();
  mesh.points[5] = {1.1, 0.5};
  EXPECT_EQ(worst_places(mesh, MeshTopology(mesh), {}).largest_area_ratio, (Point{1.05, 0.75}));
}

}  // namespace
}  // namespace quadloop
