#include "mesher/grid/tree_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

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

Geometry rectangle(Point low, Point high) { return polygon({low, {high.x, low.y}, high, {low.x, high.y}}); }

SizeOptions sizes(double min, double max, std::optional<double> aim = {}) {
  SizeOptions options;
  options.min = min;
  options.max = max;
  options.aim = aim;
  return options;
}

SizeOptions within(const RootOptions& root) {
  SizeOptions options = sizes(0.01, 0.1);
  options.root = root;
  return options;
}

/// The size of the leaves that a request yields.
double reached(const TreeGrid& root, double request, double min) {
  int level = 1;
  while (level < root.finest_level(min) && root.is_larger(level, request)) ++level;
  return root.edge(level);
}

TEST(TreeGrid, ASquareFrameIsTheRoot) {
  const Geometry frame = rectangle({-9.5, -10}, {10.5, 10});
  const TreeGrid root = choose_root(frame, sizes(0.001, 1, 0.005));
  EXPECT_EQ(root.box().low, (Point{-9.5, -10}));
  EXPECT_EQ(root.box().high, (Point{10.5, 10}));
  EXPECT_EQ(root.trees_x() * root.trees_y(), 1) << "20 / 4096 is near enough";
}

TEST(TreeGrid, ARectangularFrameIsABrick) {
  const TreeGrid root = choose_root(rectangle({0, 0}, {5, 2}), sizes(0.01, 0.25));
  EXPECT_EQ(root.trees_x(), 5);
  EXPECT_EQ(root.trees_y(), 2);
  EXPECT_EQ(root.x(std::int64_t{5} << 30), 5.0);
}

TEST(TreeGrid, AFrameIsDividedIntoAsManyTreesAsMeetTheSize) {
  const TreeGrid tenths = choose_root(rectangle({0, 0}, {1, 1}), sizes(0.05, 0.1));
  EXPECT_EQ(tenths.trees_x(), 5);
  EXPECT_EQ(reached(tenths, 0.1, 0.05), 0.1);
  const TreeGrid fiftieths = choose_root(rectangle({0.3, 0}, {1.3, 1}), sizes(0.01, 0.02));
  EXPECT_EQ(fiftieths.trees_x(), 25);
  EXPECT_NEAR(reached(fiftieths, 0.02, 0.01), 0.02, 1e-15);
}

/// As no leaf is smaller than min, leaves are larger than the size rather than twice as large.
TEST(TreeGrid, ASizeThatIsAlsoTheSmallestIsMetFromAbove) {
  const TreeGrid root = choose_root(rectangle({-10, -10}, {10, 10}), sizes(0.0055, 1, 0.0055));
  EXPECT_GE(reached(root, 0.0055, 0.0055), 0.0055 * (1 - 1e-12));
  EXPECT_LE(reached(root, 0.0055, 0.0055), 0.0055 * 1.0625);
}

TEST(TreeGrid, OtherShapesArePadded) {
  const Geometry diamond = polygon({{0, -1}, {3, 0}, {0, 1}, {-3, 0}});
  for (const double size : {0.01, 0.07, 0.3, 0.9, 50.0}) {
    const TreeGrid root = choose_root(diamond, sizes(size / 3, size));
    EXPECT_LT(root.box().low.x, -3);
    EXPECT_GT(root.box().high.y, 1);
    EXPECT_LT(root.trees_x() * root.tree_edge(), 2 * (6 + 6.0 / 32) * 1.01);
    if (size < 1) {
      EXPECT_NEAR(reached(root, size, size / 3), size, 1e-12 * size);
      EXPECT_EQ(reached(root, size, size), reached(root, size, size / 3)) << "min = max";
    }
  }
}

/// A channel with a curved floor, of which the translation is one period.
TEST(TreeGrid, APeriodAlongAnAxisIsANumberOfTrees) {
  for (const double size : {0.012, 0.07, 0.11, 0.3}) {
    SizeOptions options = sizes(size / 3, size);
    const Geometry channel = polygon({{0.1, 0}, {2, 0.4}, {4.6, 0}, {4.6, 2}, {0.1, 2}});
    options.periods = {{4.5, 0}};
    const TreeGrid root = choose_root(channel, options);
    EXPECT_EQ(root.box().low.x, 0.1);
    EXPECT_EQ(root.box().high.x, 4.6);
    EXPECT_LT(root.box().low.y, 0);
    EXPECT_GT(root.box().high.y, 2);
    EXPECT_NEAR(reached(root, size, size / 3) / size, 1, 0.1);
    EXPECT_NEAR(root.box_of({0, 0, 0}).height(), root.tree_edge(), 1e-12) << "trees are square";
    // The sides are not straight: the grid has the same lines at both of them.
    const Geometry skew = polygon({{0.1, 0}, {0.6, 1}, {0.1, 2}, {4.6, 2}, {5.1, 1}, {4.6, 0}});
    const TreeGrid wider = choose_root(skew, options);
    EXPECT_LT(wider.box().low.x, 0.1);
    EXPECT_GT(wider.box().high.x, 5.1);
    const double trees = 4.5 / wider.tree_edge();
    EXPECT_NEAR(trees, std::round(trees), 1e-12);
    EXPECT_NEAR(reached(wider, size, size / 3) / size, 1, 0.1);
  }
  SizeOptions slanted = sizes(0.1, 0.3);
  const Geometry diamond = polygon({{0, -1}, {3, 0}, {0, 1}, {-3, 0}});
  const Box box = choose_root(diamond, slanted).box();
  slanted.periods = {{1, 2}, {0, 0}};
  EXPECT_EQ(choose_root(diamond, slanted).box().low, box.low) << "no translation along an axis";
}

TEST(TreeGrid, MeetsRandomSizes) {
  std::mt19937 random(20261126);
  const auto between = [&](double low, double high) {
    return std::exp(std::uniform_real_distribution(std::log(low), std::log(high))(random));
  };
  for (int i = 0; i < 2000; ++i) {
    const double edge = between(0.1, 100), max = edge * between(0.001, 0.2), aim = max * between(0.001, 1),
                 min = i % 3 == 0 ? aim : aim * between(0.01, 1);
    const Point low{between(0.01, 100), -between(0.01, 100)}, high = low + Point{edge, edge};
    const SizeOptions options = sizes(min, max, i % 2 == 0 ? std::optional(aim) : std::nullopt);
    const double request = options.aim.value_or(max);
    const TreeGrid framing = choose_root(rectangle(low, high), options);
    EXPECT_NEAR(reached(framing, request, min) / request, 1, 0.1) << "size " << request << " in " << edge;
    if (edge / request > 32) {
      EXPECT_EQ(framing.box().low, low);
      EXPECT_EQ(framing.box().high, high);
      EXPECT_NEAR(reached(framing, request, min) / request, 1, 0.0626)
          << "size " << request << " in " << edge;
    }
    const TreeGrid around = choose_root(polygon({low, {high.x, low.y}, high}), options);
    EXPECT_NEAR(reached(around, request, min) / request, 1, 1e-9) << "size " << request << " in " << edge;
    EXPECT_GE(around.edge(1), 0.99 * std::min(max, edge / 2)) << "max is not missed by more than a level";
  }
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
  EXPECT_THROW(choose_root(square, within(RootOptions{low, 0.1, 1, 1})), InputError);
  const TreeGrid root = choose_root(square, within(RootOptions{low, 0.1, 1, 1, high}));
  EXPECT_EQ(root.box().high, high);
}

TEST(TreeGrid, GeometryOutsideTheUsersRootIsRefused) {
  EXPECT_THROW(choose_root(polygon({{0, 0}, {1, 0}, {1, 1}}), within(RootOptions{{0, 0}, 0.5, 1, 1})),
               InputError);
}

}  // namespace
}  // namespace quadloop
