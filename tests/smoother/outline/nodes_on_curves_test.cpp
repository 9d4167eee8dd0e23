// Boundary nodes move from chords onto curves, and places on curves are found again.
#include "smoother/outline/nodes_on_curves.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "smoother/outline/outline_path.hpp"
#include "tests/smoother/whole_meshes.hpp"

namespace quadloop::smoother {
namespace {

using test::self;

/// The unit square, its lower side bent downwards: one cubic curve.
Geometry bent_square(double depth) {
  GeometryBuilder builder;
  Curve curve;
  curve.inner = {{0.3, -depth}, {0.7, -depth}};
  builder.add({0, 0}, BoundaryId{0}, curve);
  for (const Point p : {Point{1, 0}, Point{1, 1}, Point{0, 1}}) builder.add(p, BoundaryId{1});
  builder.end_loop();
  std::vector<Boundary> boundaries(2);
  boundaries[0].name = "curve";
  boundaries[1].name = "box";
  return std::move(builder).geometry(boundaries);
}

/// The unit square with five nodes along its lower side.
Mesh five_below() {
  Mesh mesh;
  for (int i = 0; i < 5; ++i) mesh.points.push_back({0.25 * i, 0});
  mesh.points.insert(mesh.points.end(), {{1, 1}, {0, 1}});
  mesh.owned_nodes = 7;
  const auto n = [](int i) { return NodeId{i}; };
  mesh.triangles = {
      {n(0), n(1), n(6)}, {n(1), n(2), n(6)}, {n(2), n(5), n(6)}, {n(2), n(3), n(5)}, {n(3), n(4), n(5)}};
  BoundaryEdges below, box;
  below.name = "curve";
  box.name = "box";
  for (int i = 0; i < 4; ++i) below.edges.push_back({n(i), n(i + 1)});
  box.edges = {{n(4), n(5)}, {n(5), n(6)}, {n(6), n(0)}};
  mesh.boundaries = {below, box};
  return mesh;
}

TEST(NodesOnCurves, NodesOfChordsMoveAndOthersStay) {
  const Geometry geometry = bent_square(0.1);
  Mesh mesh = five_below();
  const Mesh before = mesh;
  const NodeFlags moved = move_nodes_to_curves(self(), geometry, mesh);
  for (const NodeId node : moved.ids()) {
    const bool inside_curve = node.value() >= 1 && node.value() <= 3;
    EXPECT_EQ(moved[node], inside_curve ? 1 : 0) << node.value();
    const Point p = before.point(node);
    EXPECT_EQ(mesh.point(node), inside_curve ? geometry.on_curve(0, p) : p);
  }
  EXPECT_NEAR(mesh.points[2].y, -0.075, 1e-15);  // the middle of the curve
}

TEST(NodesOnCurves, WithoutCurvesNothingMoves) {
  GeometryBuilder builder;
  for (const Point p : {Point{0, 0}, Point{1, 0}, Point{1, 1}, Point{0, 1}}) builder.add(p, BoundaryId{0});
  builder.end_loop();
  std::vector<Boundary> boundaries(1);
  boundaries[0].name = "curve";
  Mesh mesh = five_below();
  const Mesh before = mesh;
  EXPECT_TRUE(move_nodes_to_curves(self(), std::move(builder).geometry(boundaries), mesh).empty());
  EXPECT_EQ(mesh.points, before.points);
}

TEST(NodesOnCurves, PlacesOnACurveAreFoundAndFollowed) {
  const Geometry geometry = bent_square(0.1);
  const OutlinePath path(geometry);
  const Point p = geometry.on_curve(0, {0.3, 0});
  const OutlinePlace place = path.locate(p, "curve");
  ASSERT_TRUE(place.valid());
  EXPECT_EQ(place.segment, 0);
  EXPECT_NEAR(place.arc, 0.3, 1e-15);  // arc lengths are those of chords
  EXPECT_LT(length(path.point_at(place) - p), 1e-15);
  EXPECT_LT(length(path.point_at(path.moved(place, 0.2)) - geometry.on_curve(0, {0.5, 0})), 1e-15);
  EXPECT_FALSE(path.locate({0.3, 0}, "curve").valid()) << "the chord is not the curve";
  std::vector<Point> points(2);
  path.points_at(place, std::vector<double>{0.1, -0.1}, points);
  EXPECT_LT(length(points[0] - geometry.on_curve(0, {0.4, 0})), 1e-15);
  EXPECT_LT(length(points[1] - geometry.on_curve(0, {0.2, 0})), 1e-15);
}

}  // namespace
}  // namespace quadloop::smoother
