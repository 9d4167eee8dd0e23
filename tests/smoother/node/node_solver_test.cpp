// What a solver proposes is better by the rule, for any star; perfect stars are left alone and displaced
// nodes come back.
#include "smoother/node/node_solver.hpp"

#include <gtest/gtest.h>

#include "smoother/node/method.hpp"
#include "smoother/node/newton.hpp"
#include "tests/smoother/rounding.hpp"
#include "tests/smoother/stars.hpp"

namespace quadloop::smoother {
namespace {

using test::Cells;
using test::degrees_rounding;
using test::Random;
using test::rounding;
using test::uniform;

class EachSolver : public testing::TestWithParam<std::tuple<Method, Objective>> {
 protected:
  std::optional<Point> improve(const Star& star, Point p) { return solver_->improve(star, p, objective()); }
  static Method method() { return std::get<0>(GetParam()); }
  static Objective objective() { return std::get<1>(GetParam()); }

  /// So near the centre of a regular star, as a share of its edges, a visit leaves its node: the shortest
  /// step, or where nlopt finds that the cost, the eighth power of the distance, hardly falls any more.
  static double reach() { return method() == Method::nlopt ? 0.1 : 0.02; }

  /// Where visit after visit leads to, a few hundred at most.
  Point settle(const Star& star, Point p) {
    for (int visit = 0; visit < 200; ++visit) {
      const auto better = improve(star, p);
      if (!better) break;
      p = *better;
    }
    return p;
  }

 private:
  std::unique_ptr<NodeSolver> solver_ = make_node_solver(method());
};

INSTANTIATE_TEST_SUITE_P(Solvers, EachSolver,
                         testing::Combine(testing::Values(Method::perturb, Method::nlopt),
                                          testing::Values(Objective::power, Objective::thesis)));

TEST(Method, OfEachWordHasASolver) {
  for (const auto& [word, method] : method_words) EXPECT_NE(make_node_solver(method), nullptr) << word;
}

TEST(Newton, StepsAreShort) {
  const Star star = test::fan_of(test::regular_polygon(6));
  Newton newton;
  const auto end = newton.improve(star, {0.5, 0}, Objective::power);
  ASSERT_TRUE(end.has_value());
  EXPECT_LT(end->x, 0.5);
  EXPECT_GT(end->x, 0.5 - 3 * 0.1);  // three moves of 0.08 mean edges, which are 1.05 at most
}

TEST_P(EachSolver, OnlyBettersAStar) {
  Random random(21);
  int improved = 0, tried = 0;
  for (int i = 0; i < 300; ++i) {
    const Star star = test::random_star(random, static_cast<Cells>(i % 3), i % 2 == 1);
    const Point p = uniform(random, 0, 0.4) * test::random_direction(random);
    const auto before = star.cost(p, objective());
    if (!before.valid[0]) continue;
    ++tried;
    const auto better = improve(star, p);
    if (!better) continue;
    ++improved;
    const auto after = star.cost(*better, objective());
    EXPECT_TRUE(after.valid[0]);
    EXPECT_LT(after.objective[0], before.objective[0]);
    EXPECT_LE(test::largest_cost(star, *better), test::largest_cost(star, p) + rounding);
    EXPECT_GE(test::smallest_degrees(star, *better), test::smallest_degrees(star, p) - degrees_rounding);
  }
  EXPECT_GT(2 * improved, tried);
}

TEST_P(EachSolver, IsAFunctionOfItsArguments) {
  Random random(22);
  const auto other = make_node_solver(method());
  for (int i = 0; i < 50; ++i) {
    const Star star = test::random_star(random, Cells::mixed),
               before = test::random_star(random, Cells::triangles);
    const auto first = improve(star, {0, 0});
    other->improve(before, {0.1, 0}, objective());
    EXPECT_EQ(first, other->improve(star, {0, 0}, objective()));
  }
}

TEST_P(EachSolver, LeavesPerfectStarsAlone) {
  EXPECT_EQ(improve(test::fan_of(test::regular_polygon(6)), {0, 0}), std::nullopt);
  EXPECT_EQ(improve(test::quad_patch(), {0, 0}), std::nullopt);
}

TEST_P(EachSolver, ComesBackToTheCentre) {
  const std::vector<Star> stars{test::fan_of(test::regular_polygon(6)), test::quad_patch()};
  for (const Star& star : stars) {
    for (const Point start : {Point{0.5, 0}, Point{0.1, -0.4}, Point{-0.3, 0.3}, Point{-0.2, -0.1}}) {
      const Point end = settle(star, start);
      EXPECT_LT(length(end), reach()) << "from " << start.x << " " << start.y;
      EXPECT_LT(test::largest_cost(star, end), 1e-4);
    }
  }
}

TEST_P(EachSolver, DoesTheSameFarFromTheOriginAndInAnotherUnit) {
  for (const auto& [centre, radius] :
       {std::pair{Point{1000, -500}, 1.0}, {Point{0, 0}, 1e-6}, {Point{0, 0}, 1e6}}) {
    const Star star = test::fan_of(test::regular_polygon(6, centre, radius));
    EXPECT_LT(length(settle(star, centre + radius * Point{0.3, 0.2}) - centre), reach() * radius);
  }
}

TEST(Acceptance, TakesNoWorseAngleNorCostNorAnInvertedCorner) {
  const Star star = test::fan_of(test::regular_polygon(6));
  const Acceptance rule(star.cost({0.3, 0}, Objective::power));
  const auto accepts = [&](Point p) { return rule.accepts(star.cost(p, Objective::power), 0); };
  EXPECT_TRUE(accepts({0.2, 0}));
  EXPECT_FALSE(accepts({0.3, 0})) << "no gain";
  EXPECT_FALSE(accepts({0.4, 0}));
  EXPECT_FALSE(accepts({1.5, 0})) << "inverted";
}

TEST(Acceptance, TakesTheCheapestAcceptedPlaceOfThoseThatCount) {
  const Star star = test::fan_of(test::regular_polygon(6));
  const Acceptance rule(star.cost({0.3, 0}, Objective::power));
  Star::Batch x, y = Star::Batch::Zero();
  x << 0.4, 0.2, 1.5, 0.1, 0.1, 0.3, 0.25, 0;
  const auto cost = star.cost(x, y, Objective::power);
  EXPECT_EQ(rule.best(cost, 8), 7);
  EXPECT_EQ(rule.best(cost, 7), 3) << "of equal ones the first";
  EXPECT_EQ(rule.best(cost, 3), 1);
  EXPECT_EQ(rule.best(cost, 1), -1);
}

/// A place that lowers the node's cost is refused where it makes the smallest angle smaller, or the largest
/// cost larger.
TEST(Acceptance, RefusesGainsThatCostTheWorst) {
  Random random(23);
  int refused_for_angle = 0, refused_for_cost = 0;
  for (int i = 0; i < 2000; ++i) {
    const Star star = test::random_star(random, static_cast<Cells>(i % 3));
    const Point p{0, 0}, to = uniform(random, 0, 0.2) * test::random_direction(random);
    const auto before = star.cost(p, Objective::power), after = star.cost(to, Objective::power);
    if (!after.valid[0] || after.objective[0] > 0.99 * before.objective[0]) continue;
    const bool sharper =
        test::smallest_degrees(star, to) < test::smallest_degrees(star, p) - degrees_rounding;
    const bool dearer = test::largest_cost(star, to) > test::largest_cost(star, p) + rounding;
    EXPECT_EQ(Acceptance(before).accepts(after, 0), !sharper && !dearer);
    refused_for_angle += sharper ? 1 : 0;
    refused_for_cost += dearer ? 1 : 0;
  }
  EXPECT_GT(refused_for_angle, 10);
  EXPECT_GT(refused_for_cost, 10);
}

}  // namespace
}  // namespace quadloop::smoother
