// What a star is worth: batches against single places, objectives against their formulas, gradients against
// differences.
#include "smoother/objective/star.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "smoother/objective/objective.hpp"
#include "tests/smoother/rounding.hpp"
#include "tests/smoother/stars.hpp"

namespace quadloop::smoother {
namespace {

using test::Cells;
using test::Random;
using test::rounding;
using test::uniform;

/// Calls `check(star, random)` for many stars of all kinds.
template <class Check>
void for_each_star(const Check& check) {
  Random random(11);
  for (int i = 0; i < 100; ++i) {
    for (const Cells cells : {Cells::triangles, Cells::quads, Cells::mixed}) {
      const Star star = test::random_star(random, cells, i % 2 == 1);
      check(star, random);
    }
  }
}

Point near_centre(Random& random, double reach) {
  return uniform(random, 0, reach) * test::random_direction(random);
}

bool is_valid(const Star& star, Point p) { return star.cost(p, Objective::power).valid[0]; }

/// What the wall of NloptSolver is built on.
TEST(Star, InAValidOneNoObjectiveExceedsTheNumberOfCorners) {
  for_each_star([](const Star& star, Random& random) {
    const Point p = near_centre(random, 0.6);
    if (!is_valid(star, p)) return;
    for (const auto& [word, objective] : objective_words)
      EXPECT_LE(star.cost(p, objective).objective[0], static_cast<double>(star.corners().size())) << word;
  });
}

TEST(Star, ABatchIsItsPlacesOneByOne) {
  for_each_star([](const Star& star, Random& random) {
    Star::Batch x, y;
    for (int k = 0; k < Star::batch; ++k) {
      const Point p = near_centre(random, 0.6);
      x[k] = p.x;
      y[k] = p.y;
    }
    for (const Objective objective : {Objective::thesis, Objective::power}) {
      const auto batch = star.cost(x, y, objective);
      for (int k = 0; k < Star::batch; ++k) {
        const auto one = star.cost(Point{x[k], y[k]}, objective);
        EXPECT_EQ(batch.valid[k], one.valid[0]);
        if (!one.valid[0]) continue;
        EXPECT_EQ(batch.objective[k], one.objective[0]);
        EXPECT_EQ(batch.largest_defect[k], one.largest_defect[0]);
        EXPECT_EQ(batch.largest_cotangent[k], one.largest_cotangent[0]);
      }
    }
  });
}

TEST(Star, ObjectivesAreTheirFormulas) {
  for_each_star([](const Star& star, Random& random) {
    const Point p = near_centre(random, 0.3);
    if (!is_valid(star, p)) return;
    double squares = 0, sum = 0, largest = 0;
    for (const double cost : test::corner_costs(star, p)) {
      squares += cost * cost;
      sum += cost;
      largest = std::max(largest, cost);
    }
    const double blend = (std::tanh(5 * (largest - 1)) + 1) / 2,
                 mean = sum / static_cast<double>(star.corners().size());
    EXPECT_NEAR(star.cost(p, Objective::power).objective[0], squares, rounding);
    EXPECT_NEAR(star.cost(p, Objective::thesis).objective[0], blend * largest + (1 - blend) * mean, rounding);
  });
}

TEST(NodalCost, ByHand) {
  EXPECT_NEAR(nodal_cost(1, 0.5), 0.75, rounding);  // tanh 0 = 0: half of each
  EXPECT_NEAR(nodal_cost(0.3, 0.3), 0.3, rounding);
  const double blend = 1 / (1 + std::exp(2.0));  // (tanh(-1) + 1) / 2
  EXPECT_NEAR(nodal_cost(0.8, 0.2), blend * 0.8 + (1 - blend) * 0.2, rounding);
}

TEST(NodalCost, OfAnInvertedCornerIsItsOwnSquared) {
  // c = 1 - J with J < 0, so (1 - J)^2 = c^2, whatever the mean.
  for (const double mean : {0.1, 0.9, 1.5}) EXPECT_EQ(nodal_cost(1.5, mean), 2.25);
  EXPECT_GT(nodal_cost(std::nextafter(1.0, 2.0), 0), nodal_cost(1, 1))
      << "an inverted corner costs more than any flat one";
}

TEST(Star, NodalCostOfAnInvertedStarByHand) {
  const Star star = test::fan_of({{1, 0}, {0, 1}, {-1, 0}, {0, -1}});
  // From (2, 0) J is -1 twice and 3 twice: over 5, the smallest is -0.2.
  EXPECT_NEAR(star.nodal_cost({2, 0}, 5), 1.2 * 1.2, rounding);
  // From (2, 1) it is -2, 0, 4 and 2: one inverted, one flat.
  EXPECT_NEAR(star.nodal_cost({2, 1}, 5), 1.4 * 1.4, rounding);
  EXPECT_GT(star.nodal_cost({0.5, 0.5}, 5), 0.5) << "flat: half of 1 and half of the mean";
  EXPECT_LT(star.nodal_cost({0.5, 0.5}, 5), 1);
}

TEST(Star, NodalCostIsEquation34) {
  int inverted = 0;
  for_each_star([&](const Star& star, Random& random) {
    const Point p = near_centre(random, 1.5);
    const double reference = star.reference({0, 0});
    double smallest = std::numeric_limits<double>::infinity();
    for (const StarCorner& c : star.corners())
      smallest = std::min(smallest, cross(c.q - p, c.r - p) / reference);
    if (is_valid(star, p)) {
      EXPECT_NEAR(star.nodal_cost(p, reference), star.cost(p, Objective::thesis).objective[0], rounding);
    } else if (smallest < 0) {
      ++inverted;
      EXPECT_NEAR(star.nodal_cost(p, reference), std::pow(1 - smallest, 2),
                  rounding * std::pow(1 - smallest, 2));
    }
  });
  EXPECT_GT(inverted, 50);
}

TEST(Star, ThesisObjectiveOfARightAngledStarByHand) {
  // Four right isosceles triangles, each of cost (1 - sqrt(3) / 2)^2: largest and mean are the same.
  const Star star = test::fan_of({{1, 0}, {0, 1}, {-1, 0}, {0, -1}});
  const double cost = std::pow(1 - std::numbers::sqrt3 / 2, 2);
  EXPECT_NEAR(star.cost({0, 0}, Objective::thesis).objective[0], cost, rounding);
  EXPECT_NEAR(star.cost({0, 0}, Objective::power).objective[0], 4 * cost * cost, rounding);
  EXPECT_NEAR(star.cost({0, 0}, Objective::power).largest_cotangent[0], 1, rounding);  // 45 degrees
}

TEST(Star, LargestDefectAndCotangentAreTheWorstCornersAndTheSmallestAngles) {
  for_each_star([](const Star& star, Random& random) {
    const Point p = near_centre(random, 0.3);
    if (!is_valid(star, p)) return;
    const auto cost = star.cost(p, Objective::power);
    EXPECT_NEAR(std::pow(cost.largest_defect[0], 2), test::largest_cost(star, p), rounding);
    EXPECT_NEAR(star.worst_cost(p), test::largest_cost(star, p), rounding);
    EXPECT_NEAR(std::atan2(1, cost.largest_cotangent[0]) * 180 / std::numbers::pi,
                test::smallest_degrees(star, p), 1e-9);
  });
}

/// The gradient by central differences, far from where another corner becomes the worst.
Point differences(const Star& star, Point p, Objective objective) {
  constexpr double h = 1e-6;
  const auto value = [&](Point at) { return star.cost(at, objective).objective[0]; };
  return {(value(p + Point{h, 0}) - value(p - Point{h, 0})) / (2 * h),
          (value(p + Point{0, h}) - value(p - Point{0, h})) / (2 * h)};
}

/// By how much the worst corner is worse than the next.
double lead_of_worst(const Star& star, Point p) {
  std::vector<double> costs = test::corner_costs(star, p);
  std::sort(costs.begin(), costs.end());
  return costs.back() - costs[costs.size() - 2];
}

/// The sum of the corners' defects, each to the third power, and its gradient by differences.
double sum_of_cubes(const Star& star, Point p) {
  double sum = 0;
  for (const double cost : test::corner_costs(star, p)) sum += std::pow(cost, 1.5);
  return sum;
}
Point slope_of_cubes(const Star& star, Point p) {
  constexpr double h = 1e-6;
  const auto value = [&](Point at) { return sum_of_cubes(star, at); };
  return {(value(p + Point{h, 0}) - value(p - Point{h, 0})) / (2 * h),
          (value(p + Point{0, h}) - value(p - Point{0, h})) / (2 * h)};
}

TEST(Star, AModelIsOfSecondOrder) {
  constexpr double h = 1e-5;
  int compared = 0;
  for_each_star([&](const Star& star, Random& random) {
    const Point p = near_centre(random, 0.3);
    if (test::largest_cost(star, p) > 0.9) return;  // too steep for differences
    const StarModel model = star.model(p);
    EXPECT_NEAR(model.cubes, sum_of_cubes(star, p), rounding);
    EXPECT_EQ(model.reference, star.reference(p));
    const Point slope = slope_of_cubes(star, p);
    EXPECT_LT(length(model.gradient - slope), 1e-6 * (1 + length(slope)));
    const auto bend = [&](Point by) {
      return 1 / (2 * h) * (slope_of_cubes(star, p + h * by) - slope_of_cubes(star, p - h * by));
    };
    const Point along_x = bend({1, 0}), along_y = bend({0, 1});
    const double size = 1 + length(along_x) + length(along_y);
    EXPECT_NEAR(model.xx, along_x.x, 1e-4 * size);
    EXPECT_NEAR(model.xy, along_x.y, 1e-4 * size);
    EXPECT_NEAR(model.yy, along_y.y, 1e-4 * size);
    ++compared;
  });
  EXPECT_GT(compared, 200);
}

TEST(Star, AModelsCostIsTheCostToTheLastBit) {
  for_each_star([](const Star& star, Random& random) {
    const Point p = near_centre(random, 1.2);
    const StarCost<1> cost = star.cost(p, Objective::power), of_model = star.model(p).cost;
    EXPECT_EQ(of_model.valid[0], cost.valid[0]);
    if (!cost.valid[0]) return;
    EXPECT_EQ(of_model.objective[0], cost.objective[0]);
    EXPECT_EQ(of_model.largest_defect[0], cost.largest_defect[0]);
    EXPECT_EQ(of_model.largest_cotangent[0], cost.largest_cotangent[0]);
  });
}

TEST(Star, GradientsAgreeWithDifferences) {
  int compared = 0;
  for_each_star([&](const Star& star, Random& random) {
    const Point p = near_centre(random, 0.3);
    if (test::largest_cost(star, p) > 0.98) return;  // nearly flat: too steep for differences
    for (const Objective objective : {Objective::thesis, Objective::power}) {
      if (objective == Objective::thesis && lead_of_worst(star, p) < 1e-4) continue;
      Point gradient;
      EXPECT_NEAR(star.cost_and_gradient(p, objective, gradient), star.cost(p, objective).objective[0],
                  rounding);
      const Point expected = differences(star, p, objective);
      EXPECT_LT(length(gradient - expected), 1e-6 * (1 + length(expected)));
      ++compared;
    }
  });
  EXPECT_GT(compared, 400);
}

TEST(Star, GradientsAgreeWhereTheLargestCostCounts) {
  const Star star = test::fan_of({{1, 0}, {0, 1}, {-1, 0}, {0, -1}});
  const Point p{0.47, 0.46};  // the blend is some 0.3 there
  ASSERT_GT(test::largest_cost(star, p), 0.8);
  Point gradient;
  star.cost_and_gradient(p, Objective::thesis, gradient);
  EXPECT_LT(length(gradient - differences(star, p, Objective::thesis)), 1e-6 * length(gradient));
}

TEST(Star, InversionAndReferenceByHand) {
  const Star star = test::fan_of({{1, 0}, {0, 1}, {-1, 0}, {0, -1}});
  EXPECT_EQ(star.inversion({0, 0}, 1), 0);
  EXPECT_EQ(star.reference({0, 0}), 1);
  // From (2, 0) the edges' squares are 1, 5, 9, 5; J is -1 twice and 3 twice.
  EXPECT_EQ(star.reference({2, 0}), 5);
  EXPECT_EQ(star.inversion({2, 0}, 5), 0.4);
  EXPECT_EQ(star.worst_cost({2, 0}), 1.2);
  EXPECT_EQ(star.sound_corners({2, 0}), (std::vector<char>{0, 1, 1, 0}));
  EXPECT_FALSE(is_valid(star, {2, 0}));
  EXPECT_FALSE(is_valid(star, {0.5, 0.5})) << "one corner is flat";
  EXPECT_EQ(star.worst_cost({0.5, 0.5}), 1);
}

TEST(Star, IsValidWhereAllCornersAreSound) {
  int invalid = 0;
  for_each_star([&](const Star& star, Random& random) {
    const Point p = near_centre(random, 1.2);
    const auto sound = star.sound_corners(p);
    EXPECT_EQ(is_valid(star, p), std::count(sound.begin(), sound.end(), 0) == 0);
    EXPECT_EQ(is_valid(star, p), star.worst_cost(p) < 1);
    invalid += is_valid(star, p) ? 0 : 1;
  });
  EXPECT_GT(invalid, 50);
}

TEST(Star, NewCornersReplaceTheOldOnes) {
  const Star patch = test::quad_patch();
  Star star = patch;
  ASSERT_EQ(star.corners().size(), 12U);
  star.assign(2, [&](std::size_t c) { return patch.corners()[10 + c]; });
  ASSERT_EQ(star.corners().size(), 2U);
  EXPECT_EQ(star.corners()[1].q, patch.corners()[11].q);
  star.assign(0, [&](std::size_t c) { return patch.corners()[c]; });
  EXPECT_TRUE(star.empty());
}

}  // namespace
}  // namespace quadloop::smoother
