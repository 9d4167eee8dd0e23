#include "mesher/sizes/proximity.hpp"

#include <gtest/gtest.h>

#include <numeric>

namespace quadloop {
namespace {

/// A frame, and in it two bars that are 0.02 apart: segments 4 to 7 above, 8 to 11 below.
Geometry two_bars() {
  const std::vector<Point> points{{-1, -1},      {1, -1},       {1, 1},       {-1, 1},
                                  {-0.5, 0.01},  {-0.5, 0.21},  {0.5, 0.21},  {0.5, 0.01},
                                  {-0.5, -0.21}, {-0.5, -0.01}, {0.5, -0.01}, {0.5, -0.21}};
  return {{{"wall"}}, points, {0, 4, 8, 12}, std::vector<BoundaryId>(12, BoundaryId{0})};
}

TEST(Proximity, FindsWhereSidesFaceEachOther) {
  const Geometry geometry = two_bars();
  const Proximity proximity(geometry);
  const Box middle{{-0.1, -0.1}, {0.1, 0.1}};
  const std::vector<std::int32_t> lower_side{7}, upper_side{5};
  EXPECT_TRUE(proximity.narrower(lower_side, middle, 0.021));
  EXPECT_FALSE(proximity.narrower(lower_side, middle, 0.019));
  EXPECT_FALSE(proximity.narrower(upper_side, {{-0.1, 0.1}, {0.1, 0.3}}, 0.3)) << "between them lies the bar";
  EXPECT_TRUE(proximity.narrower(upper_side, {{-0.1, 0.1}, {0.1, 0.3}}, 0.8)) << "the frame is 0.79 away";
  EXPECT_FALSE(proximity.narrower({}, middle, 1));
}

TEST(Proximity, AGapLiesInOneBlock) {
  // As the two directions of an interface do where rounding separates them.
  const Geometry one = two_bars();
  const std::vector<Point> points{one.points().begin(), one.points().end()};
  const auto in_blocks = [&](const std::vector<std::int32_t>& of_loop) {
    return Geometry({{"wall"}}, points, {0, 4, 8, 12}, std::vector<BoundaryId>(12, BoundaryId{0}), {},
                    {{"a", "b"}, of_loop});
  };
  const Geometry same = in_blocks({0, 1, 1}), other = in_blocks({0, 0, 1});
  const Box middle{{-0.1, -0.1}, {0.1, 0.1}};
  const std::vector<std::int32_t> lower_side{7};
  EXPECT_TRUE(Proximity(same).narrower(lower_side, middle, 0.021));
  EXPECT_FALSE(Proximity(other).narrower(lower_side, middle, 0.021));
}

TEST(Proximity, OnlyThePieceInTheBoxCounts) {
  const Geometry geometry = two_bars();
  const Proximity proximity(geometry);
  const std::vector<std::int32_t> frame_right{1};
  EXPECT_TRUE(proximity.narrower(frame_right, {{0.9, 0.0}, {1.1, 0.2}}, 0.51));
  EXPECT_FALSE(proximity.narrower(frame_right, {{0.9, 0.8}, {1.1, 1.1}}, 0.51));
}

TEST(Proximity, TheSidesOfACornerAreNoGap) {
  const Geometry geometry({{"wall"}}, {{0, 0}, {4, 0}, {4, 1}}, {0, 3},
                          std::vector<BoundaryId>(3, BoundaryId{0}));
  const Proximity proximity(geometry);
  std::vector<std::int32_t> all(3);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_FALSE(proximity.narrower(all, {{-1, -1}, {0.5, 0.5}}, 0.3));
}

}  // namespace
}  // namespace quadloop
