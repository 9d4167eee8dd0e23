#include "mesher/geometry/segment_tree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace quadloop {
namespace {

/// Loops of as many points each, in a row.
Geometry stars(const std::vector<std::int32_t>& sizes) {
  std::vector<Point> points;
  std::vector<std::int32_t> starts{0};
  for (const std::int32_t size : sizes) {
    for (std::int32_t i = 0; i < size; ++i) {
      const double angle = 2 * std::numbers::pi * i / size, radius = 1 + 0.3 * std::sin(7 * angle);
      points.push_back(
          {3.0 * static_cast<double>(starts.size()) + radius * std::cos(angle), radius * std::sin(angle)});
    }
    starts.push_back(size32(points));
  }
  std::vector<BoundaryId> boundary(points.size(), BoundaryId{0});
  Boundary wall;
  wall.name = "wall";
  return {{wall}, std::move(points), std::move(starts), std::move(boundary)};
}

TEST(SegmentTree, FindsWhatMeetsABoxAndNothingElse) {
  const Geometry g = stars({3, 8, 16, 17, 100, 5});
  const SegmentTree tree(g);
  for (double x = 0; x < 22; x += 0.13) {
    for (const double width : {0.0, 0.05, 1.0, 9.0}) {
      const Box box{{x, 1 - 0.1 * x}, {x + width, 1 - 0.1 * x + width / 2}};
      std::vector<std::int32_t> wanted, found;
      for (std::int32_t s = 0; s < g.size(); ++s) {
        if (box_of(g.point(s), g.point(g.next(s))).meets(box)) wanted.push_back(s);
      }
      tree.for_each_meeting(box, [&](std::int32_t s) { found.push_back(s); });
      std::ranges::sort(found);
      EXPECT_EQ(found, wanted);
    }
  }
}

TEST(SegmentTree, EndsWhereItIsTold) {
  const Geometry g = stars({100, 100});
  const SegmentTree tree(g);
  int asked = 0;
  EXPECT_TRUE(tree.any_meeting(g.box(), [&](std::int32_t) { return ++asked == 30; }));
  EXPECT_EQ(asked, 30);
  EXPECT_FALSE(tree.any_meeting(g.box(), [](std::int32_t) { return false; }));
}

}  // namespace
}  // namespace quadloop
