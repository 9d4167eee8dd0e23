// Cells told to cost less than a limit, or more, without their cost, against the cost.
#include "smoother/objective/cost_limit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/smoother/stars.hpp"

namespace quadloop::smoother {
namespace {

using test::Random;
using test::uniform;

template <std::size_t width>
std::array<Point, width> random_cell(Random& random) {
  const double scale = std::exp(uniform(random, -30, 30));
  std::array<Point, width> cell;
  for (Point& p : cell) p = scale * Point{uniform(random, 0, 1), uniform(random, 0, 1)};
  return cell;
}

template <std::size_t width>
void expect_kept_as_cost_says() {
  Random random(20);
  int kept = 0, inverted = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto cell = random_cell<width>(random);
    const double cost = cell_cost(cell, ideal_targets<width>()), limit = uniform(random, 0, 1.5);
    const bool is_kept = CostLimit(limit).surely_kept_by(cell);
    kept += is_kept ? 1 : 0;
    inverted += cost >= 1 ? 1 : 0;
    EXPECT_EQ(is_kept, cost < std::min(limit, 1.0)) << "cost " << cost << ", limit " << limit;
    EXPECT_FALSE(CostLimit(cost).surely_kept_by(cell));
    if (limit < 1) {
      EXPECT_EQ(CostLimit(limit).surely_missed_by(cell), cost > limit) << cost << ' ' << limit;
    }
    if (cost < 1) {
      EXPECT_FALSE(CostLimit(cost).surely_missed_by(cell));
    }
  }
  EXPECT_GT(kept, 100);
  EXPECT_GT(inverted, 100);
}

TEST(CostLimit, AgreesWithTheCostOfTriangles) { expect_kept_as_cost_says<3>(); }
TEST(CostLimit, AgreesWithTheCostOfQuads) { expect_kept_as_cost_says<4>(); }

TEST(CostLimit, BestCellsKeepAnyLimitButNone) {
  const std::array<Point, 4> square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  EXPECT_TRUE(CostLimit(1e-6).surely_kept_by(square));
  EXPECT_FALSE(CostLimit(0).surely_kept_by(square));
  const std::array<Point, 3> equilateral{{{0, 0}, {1, 0}, {0.5, std::sqrt(0.75)}}};
  EXPECT_TRUE(CostLimit(1e-6).surely_kept_by(equilateral));
  EXPECT_FALSE(CostLimit(0).surely_kept_by(equilateral));
}

TEST(CostLimit, FlatAndInvertedCellsKeepNone) {
  const double huge = std::numeric_limits<double>::max();
  for (const double limit : {0.5, 1.0, 2.0, huge}) {
    EXPECT_FALSE(CostLimit(limit).surely_kept_by(std::array<Point, 3>{{{0, 0}, {1, 0}, {2, 0}}}));
    EXPECT_FALSE(CostLimit(limit).surely_kept_by(std::array<Point, 3>{{{0, 0}, {0, 1}, {1, 0}}}));
    EXPECT_FALSE(CostLimit(limit).surely_kept_by(std::array<Point, 3>{{{1, 1}, {1, 1}, {1, 1}}}));
    EXPECT_FALSE(CostLimit(limit).surely_kept_by(std::array<Point, 4>{{{0, 0}, {1, 0}, {0.1, 0.1}, {0, 1}}}))
        << "inverted at one corner";
  }
}

}  // namespace
}  // namespace quadloop::smoother
