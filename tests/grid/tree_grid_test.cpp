#include "mesher/grid/tree_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/base/morton.hpp"

namespace quadloop {
namespace {

Geometry polygon(std::vector<Point> points) {
  std::vector<BoundaryId> boundary(points.size(), BoundaryId{0});
  const auto count = size32(points);
  return {{{"frame", 0, 30, "none"}}, std::move(points), {0, count}, std::move(boundary)};
}

TEST(TreeGrid, ASquareFrameIsTheRoot) {
  const TreeGrid root = choose_root(polygon({{-9.5, -10}, {10.5, -10}, {10.5, 10}, {-9.5, 10}}), {});
  EXPECT_EQ(root.box().low, (Point{-9.5, -10}));
  EXPECT_EQ(root.box().high, (Point{10.5, 10}));
  EXPECT_EQ(root.trees_x() * root.trees_y(), 1);
}

TEST(TreeGrid, ARectangularFrameIsABrick) {
  const TreeGrid root = choose_root(polygon({{0, 0}, {5, 0}, {5, 2}, {0, 2}}), {});
  EXPECT_EQ(root.trees_x(), 5);
  EXPECT_EQ(root.trees_y(), 2);
  EXPECT_EQ(root.x(std::int64_t{5} << 30), 5.0);
}

TEST(TreeGrid, OtherShapesArePadded) {
  const Geometry diamond = polygon({{0, -1}, {3, 0}, {0, 1}, {-3, 0}});
  const TreeGrid root = choose_root(diamond, {});
  EXPECT_LT(root.box().low.x, -3);
  EXPECT_GT(root.box().high.y, 1);
  EXPECT_LE(root.trees_y() * root.tree_edge(), (2 + 6.0 / 32) * 1.125 + 0.01);
}

TEST(TreeGrid, CoordinatesOfAMirroredRootAreMirrored) {
  const Box box{{-0.123456789, 0.1}, {1.987654321, 0.7}};
  const TreeGrid root(box, 7, 2), mirrored({{-box.high.x, box.low.y}, {-box.low.x, box.high.y}}, 7, 2);
  const std::int64_t last = std::int64_t{7} << 30;
  for (std::int64_t i = 0; i <= last; i += 123456789) {
    EXPECT_EQ(root.x(i), -mirrored.x(last - i));
    EXPECT_LT(root.x(i), root.x(i + 1024));
  }
  EXPECT_EQ(root.x(last), box.high.x);
}

TEST(GridPoint, TheCurvePassesAllOfAQuadrantBeforeTheNext) {
  std::vector<GridPoint> points;
  for (std::int64_t x = 0; x < 16; ++x) {
    for (std::int64_t y = 0; y < 16; ++y) points.push_back({x << 29, y << 29});
  }
  std::sort(points.begin(), points.end(), comes_earlier);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto column = static_cast<std::uint32_t>(points[i].x >> 29),
               row = static_cast<std::uint32_t>(points[i].y >> 29);
    EXPECT_EQ(morton_key(column, row), i);
    EXPECT_FALSE(comes_earlier(points[i], points[i]));
  }
}

TEST(TreeGrid, TooFineASpacingIsRefused) {
  const TreeGrid root({{0, 0}, {1, 1}}, 1, 1), far({{1e6, 0}, {1e6 + 1, 1}}, 1, 1);
  EXPECT_EQ(root.finest_level(0.1), 3);
  EXPECT_THROW(root.finest_level(1e-10), InputError);
  EXPECT_THROW(far.finest_level(1e-8), InputError);
}

// A corner of 1/3 and an edge of 0.1 do not add up to what the box ends at.
TEST(TreeGrid, TheUsersRootMayEndWhereItSays) {
  const Point low{1.0 / 3, 1.0 / 3}, high{std::nextafter(low.x + 0.1, 1), std::nextafter(low.y + 0.1, 1)};
  const Geometry square = polygon({low, {high.x, low.y}, high, {low.x, high.y}});
  EXPECT_THROW(choose_root(square, RootOptions{low, 0.1, 1, 1}), InputError);
  const TreeGrid root = choose_root(square, RootOptions{low, 0.1, 1, 1, high});
  EXPECT_EQ(root.box().high, high);
}

TEST(TreeGrid, GeometryOutsideTheUsersRootIsRefused) {
  EXPECT_THROW(choose_root(polygon({{0, 0}, {1, 0}, {1, 1}}), RootOptions{{0, 0}, 0.5, 1, 1}), InputError);
}

}  // namespace
}  // namespace quadloop
