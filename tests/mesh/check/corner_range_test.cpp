#include "mesher/mesh/check/corner_range.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "mesher/mesh/check/quality.hpp"

namespace quadloop {
namespace {

struct Extremes {
  double smallest, largest;
};

Extremes measured(const std::vector<CellCorner>& corners) {
  Extremes extremes{1e9, -1e9};
  for (const CellCorner& corner : corners) {
    extremes.smallest = std::min(extremes.smallest, corner.degrees());
    extremes.largest = std::max(extremes.largest, corner.degrees());
  }
  return extremes;
}

void expect_same(const std::vector<CellCorner>& corners) {
  CornerRange range;
  for (const CellCorner& corner : corners) range.include(corner);
  const Extremes extremes = measured(corners);
  EXPECT_EQ(range.smallest(), extremes.smallest);
  EXPECT_EQ(range.largest(), extremes.largest);
}

CellCorner corner_of(double degrees, double turned, double length = 1) {
  const auto at = [&](double angle) {
    return length * Point{std::cos(angle * std::numbers::pi / 180), std::sin(angle * std::numbers::pi / 180)};
  };
  return {at(turned + degrees), {0, 0}, at(turned)};
}

TEST(CornerRange, OfNoCornerHasNoEnds) {
  EXPECT_EQ(CornerRange().smallest(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(CornerRange().largest(), -std::numeric_limits<double>::infinity());
}

TEST(CornerRange, HasTheBitsOfAllMeasured) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> degrees(0.001, 179.999), turned(0, 360), exponent(-9, 9);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<CellCorner> corners;
    for (int i = 0; i < 100; ++i)
      corners.push_back(corner_of(degrees(random), turned(random), std::pow(10, exponent(random))));
    expect_same(corners);
  }
}

// Angles that differ in their last bits alone, as of a turned grid.
TEST(CornerRange, TellsAnglesThatRoundingParts) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> turned(0, 360);
  for (const double degrees : {0.01, 30.0, 45.0, 90.0, 135.0, 179.99}) {
    std::vector<CellCorner> corners;
    for (int i = 0; i < 2000; ++i) corners.push_back(corner_of(degrees, turned(random)));
    expect_same(corners);
  }
}

TEST(CornerRange, TakesFlatAndInvertedCorners) {
  const std::vector<double> all = {60, -20, 90, 0, 120, -170, 180, 30};
  for (std::size_t first = 0; first < all.size(); ++first) {
    std::vector<CellCorner> corners;
    for (std::size_t i = 0; i < all.size(); ++i)
      corners.push_back(corner_of(all[(first + i) % all.size()], 10));
    expect_same(corners);
  }
  expect_same({CellCorner({0, 0}, {0, 0}, {0, 0}), corner_of(20, 0), corner_of(40, 0)});
}

}  // namespace
}  // namespace quadloop
