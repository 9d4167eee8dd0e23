// Regions between loops, with holes.
#include "mesher/cut/hole_triangulation.hpp"

#include <gtest/gtest.h>

#include "mesher/geometry/predicates.hpp"

namespace quadloop {
namespace {

using Loop = std::vector<std::int32_t>;

struct Triangulated {
  Triangulated(const std::vector<Point>& points, const std::vector<Loop>& loops) {
    const std::vector<std::span<const std::int32_t>> views(loops.begin(), loops.end());
    triangulate_region(points, views, triangles);
    for (const auto& [a, b, c] : triangles) {
      counter_clockwise = counter_clockwise && orientation(points[a], points[b], points[c]) > 0;
      const Point u = points[b] - points[a], v = points[c] - points[a];
      area += (u.x * v.y - u.y * v.x) / 2;
    }
  }
  std::vector<std::array<std::int32_t, 3>> triangles;
  bool counter_clockwise = true;
  double area = 0;
};

TEST(HoleTriangulation, OfARing) {
  const Triangulated ring({{0, 0}, {8, 0}, {8, 8}, {0, 8}, {2, 2}, {2, 6}, {6, 6}, {6, 2}},
                          {{0, 1, 2, 3}, {4, 5, 6, 7}});
  EXPECT_EQ(ring.triangles.size(), 8U);
  EXPECT_TRUE(ring.counter_clockwise);
  EXPECT_EQ(ring.area, 48);
}

TEST(HoleTriangulation, AHoleMayTouchTheOutlineInANode) {
  const Triangulated touching({{0, 0}, {8, 0}, {8, 8}, {0, 8}, {2, 4}, {4, 2}}, {{0, 1, 2, 3}, {0, 4, 5}});
  EXPECT_EQ(touching.triangles.size(), 5U);
  EXPECT_TRUE(touching.counter_clockwise);
  EXPECT_EQ(touching.area, 64 - 6);
}

TEST(HoleTriangulation, OfAnIslandInALakeAndAnOutlineBesideThem) {
  const Triangulated nested({{0, 0},
                             {16, 0},
                             {16, 16},
                             {0, 16},  //
                             {2, 2},
                             {2, 14},
                             {14, 14},
                             {14, 2},  //
                             {6, 6},
                             {10, 6},
                             {10, 10},
                             {6, 10},  //
                             {20, 0},
                             {24, 0},
                             {20, 4}},
                            {{0, 1, 2, 3}, {4, 5, 6, 7}, {8, 9, 10, 11}, {12, 13, 14}});
  EXPECT_EQ(nested.triangles.size(), 8U + 2 + 1);
  EXPECT_TRUE(nested.counter_clockwise);
  EXPECT_EQ(nested.area, 256 - 144 + 16 + 8);
}

TEST(HoleTriangulation, EdgesOfLoopsStayThoughTheyAreNotDelaunay) {
  const std::vector<Point> points{{0, 0}, {8, 0}, {8, 1}, {0, 1}, {4, 0.25}};
  const Triangulated dented(points, {{0, 4, 1, 2, 3}});
  EXPECT_EQ(dented.triangles.size(), 3U);
  EXPECT_EQ(dented.area, 8 - 1);
}

TEST(HoleTriangulation, AppendsToWhatIsThere) {
  std::vector<std::array<std::int32_t, 3>> triangles{{7, 8, 9}};
  const std::vector<Point> points{{0, 0}, {1, 0}, {0, 1}};
  const Loop loop{0, 1, 2};
  const std::vector<std::span<const std::int32_t>> loops{loop};
  triangulate_region(points, loops, triangles);
  EXPECT_EQ(triangles.size(), 2U);
  EXPECT_EQ(triangles[0], (std::array{7, 8, 9}));
}

}  // namespace
}  // namespace quadloop
