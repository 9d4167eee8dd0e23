// The unit of length: 1 but for meshes so large or so small that products of lengths would overflow or
// vanish.
#include "smoother/binary_unit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesher/mesh/scatter_mesh.hpp"
#include "tests/support/world.hpp"

namespace quadloop::smoother {
namespace {

/// The unit of a mesh of two opposite corners of a box.
BinaryUnit unit_of(Point low, Point high) {
  Mesh mesh;
  mesh.points = {low, high};
  return {test::world(), mesh};
}

TEST(BinaryUnit, IsOneForOrdinaryMeshesWhereverTheyLie) {
  EXPECT_TRUE(unit_of({0, 0}, {1, 1}).is_one());
  EXPECT_TRUE(unit_of({1e70, -1e70}, {1e70, -1e70}).is_one()) << "no extent";
  EXPECT_TRUE(unit_of({0, 0}, {0x1p201, 1}).is_one());
  EXPECT_TRUE(unit_of({0, 0}, {0x1p-199, 0x1p-300}).is_one());
  EXPECT_TRUE(unit_of({-1e300, 3}, {-1e300, 4}).is_one()) << "one extent counts, not where it is";
}

TEST(BinaryUnit, BeyondThemTheLargerExtentIsBetweenTwoAndFourUnits) {
  for (const double extent : {0x1.8p203, 0x1p1000, 0x1.4p-250, 0x1.fp1023}) {
    for (const bool wide : {true, false}) {
      const Point high = wide ? Point{extent, extent / 8} : Point{extent / 8, extent};
      const Point low = 0.25 * high, top = 1.0 * high;
      const BinaryUnit unit = unit_of(low, top);
      EXPECT_FALSE(unit.is_one());
      const Point d = unit.into(top) - unit.into(low);
      EXPECT_GE(std::max(d.x, d.y), 2) << extent;
      EXPECT_LT(std::max(d.x, d.y), 4) << extent;
      EXPECT_EQ(unit.out_of(unit.into(top)), top);
    }
  }
}

/// A triangle of this size, each node on a rank of its own as far as there are ranks.
Mesh sized(double size) {
  Mesh mesh;
  for (const Point p : {Point{0, 0}, Point{size, 0}, Point{0, size / 2}}) mesh.points.push_back(p);
  mesh.owned_nodes = 3;
  return scatter_mesh(test::world(), mesh, own_order(mesh));
}

TEST(BinaryUnit, IsThatOfAllRanksAndLosesNoBit) {
  for (const double size : {3e-120, 7e-300, 5e99, 1.7e308}) {
    const BinaryUnit unit(test::world(), sized(size));
    EXPECT_FALSE(unit.is_one());
    const Point p{size / 3, -size / 7};
    EXPECT_GT(std::abs(unit.into(p).x), 0.05);
    EXPECT_LT(std::abs(unit.into(p).x), 4);
    EXPECT_EQ(unit.out_of(unit.into(p)), p);
  }
}

TEST(BinaryUnit, AWholeExtentMayOverflow) {
  const BinaryUnit unit = unit_of({-0x1.8p1023, 0}, {0x1.8p1023, 1});
  EXPECT_EQ(unit.into({0x1.8p1023, 0}), (Point{1.5, 0}));
}

TEST(BinaryUnit, GeometriesGoIntoItWhole) {
  const Geometry geometry({{"wall", 0x1p300, 20, "wall"}, {"rest", 0x1p301, 30, "none"}},
                          {{0, 0}, {0x1p302, 0}, {0, 0x1p303}}, {0, 3},
                          {BoundaryId{0}, BoundaryId{1}, BoundaryId{1}});
  const Geometry into = unit_of({0, 0}, {0x1p303, 0x1p303}).into(geometry);
  EXPECT_EQ(into.point(2), (Point{0, 2}));
  EXPECT_EQ(into.boundary(BoundaryId{0}).spacing, 0.25);
  EXPECT_EQ(into.boundary(BoundaryId{1}).spacing, 0.5);
  EXPECT_EQ(into.boundary_of(0), BoundaryId{0});
  EXPECT_EQ(into.boundary_of(2), BoundaryId{1});
  EXPECT_EQ(into.loop_count(), 1);
}

}  // namespace
}  // namespace quadloop::smoother
