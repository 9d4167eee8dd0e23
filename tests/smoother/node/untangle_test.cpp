// Inverted stars: the deepest place inside their polygon, and moves that lower the tangle without a new one.
#include "smoother/node/untangle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tests/smoother/stars.hpp"

namespace quadloop::smoother {
namespace {

using test::Cells;
using test::Random;
using test::uniform;

/// The smallest distance to the left of the lines through a star's opposite edges.
double depth(const Star& star, Point p) {
  double least = std::numeric_limits<double>::infinity();
  for (const StarCorner& c : star.corners())
    least = std::min(least, cross(c.r - c.q, p - c.q) / length(c.r - c.q));
  return least;
}

void expect_deepest(const std::vector<Point>& polygon, Point expected) {
  for (const Point start : {Point{0.1, 0.2}, Point{5, 3}, Point{-2, -0.5}}) {
    const Point found = deepest_point(test::fan_of(polygon), start);
    EXPECT_LT(length(found - expected), 1e-12)
        << "from " << start.x << " " << start.y << " to " << found.x << " " << found.y;
  }
}

TEST(DeepestPoint, OfKnownPolygons) {
  expect_deepest({{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {1, 1});
  expect_deepest({{0, 0}, {4, 0}, {0, 3}}, {1, 1});  // the centre of the inscribed circle
  expect_deepest(test::regular_polygon(7, {0.3, 0.4}), {0.3, 0.4});
  // An arrowhead: the kernel is the triangle between its point and the lines through its notch.
  const double long_side = std::sqrt(5.0),
               short_side = std::numbers::sqrt2;  // as deep from both: (2 - x) / sqrt(5) = (x - 1) / sqrt(2)
  expect_deepest({{0, 0}, {2, 1}, {0, 2}, {1, 1}},
                 {(2 * short_side + long_side) / (short_side + long_side), 1});
}

TEST(DeepestPoint, OfARectangleIsAnyOnItsMiddleLine) {
  const Star star = test::fan_of({{0, 0}, {4, 0}, {4, 2}, {0, 2}});
  const Point deep = deepest_point(star, {7, 7});
  EXPECT_NEAR(deep.y, 1, 1e-12);
  EXPECT_GE(deep.x, 1 - 1e-12);
  EXPECT_LE(deep.x, 3 + 1e-12);
}

TEST(DeepestPoint, FarFromTheOrigin) {
  const Point centre{1e7, -3e7};
  const Point deep = deepest_point(test::fan_of(test::regular_polygon(5, centre)), centre + Point{2, 1});
  EXPECT_LT(length(deep - centre), 1e-7);
}

TEST(DeepestPoint, IsDeeperThanAnyOther) {
  Random random(31);
  for (int i = 0; i < 60; ++i) {
    const Star star = test::random_star(random, static_cast<Cells>(i % 3));
    const double deepest = depth(star, deepest_point(star, 2 * test::random_direction(random)));
    EXPECT_GT(deepest, 0);
    for (int k = 0; k < 2000; ++k) {
      const Point other{uniform(random, -1, 1), uniform(random, -1, 1)};
      EXPECT_LE(depth(star, other), deepest + 1e-12);
    }
  }
}

/// The largest least depth at which three of the lines meet, found by trying all threes.
double depth_by_trial(const Star& star) {
  double deepest = -std::numeric_limits<double>::infinity();
  std::vector<std::pair<Point, double>> lines;
  for (const StarCorner& c : star.corners()) {
    const Point along = (1 / length(c.r - c.q)) * (c.r - c.q), n{-along.y, along.x};
    lines.emplace_back(n, -dot(n, c.q));
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      for (std::size_t k = 0; k < j; ++k) {
        const Point u = lines[i].first - lines[j].first, v = lines[i].first - lines[k].first;
        const double du = lines[j].second - lines[i].second, dv = lines[k].second - lines[i].second,
                     w = cross(u, v);
        if (std::abs(w) > 1e-12)
          deepest = std::max(deepest, depth(star, {(du * v.y - dv * u.y) / w, (u.x * dv - v.x * du) / w}));
      }
    }
  }
  return deepest;
}

TEST(DeepestPoint, IsTheBestOfAllWhereThreeLinesMeet) {
  Random random(37);
  int without_kernel = 0;
  for (int i = 0; i < 400; ++i) {
    std::vector<Point> polygon;
    const int corners = 3 + i % 14;
    for (int k = 0; k < corners; ++k) {
      const double angle = 2 * std::numbers::pi * (k + (i % 2 == 0 ? 0.4 : 1.5) * uniform(random, -1, 1)) /
                           corners,
                   radius = uniform(random, 0.1, 2);
      polygon.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    const Star star = test::fan_of(polygon);
    const double best = depth_by_trial(star);
    without_kernel += best < 0 ? 1 : 0;
    EXPECT_NEAR(depth(star, deepest_point(star, 3 * test::random_direction(random))), best, 1e-10) << i;
  }
  EXPECT_GT(without_kernel, 50);
}

TEST(DeepestPoint, OfAHubWithManySpokesIsFoundAtOnce) {  // a test of all threes would take hours
  const Point deep = deepest_point(test::fan_of(test::regular_polygon(4000, {0.3, 0.4})), {1.5, 0.4});
  EXPECT_LT(length(deep - Point{0.3, 0.4}), 1e-9);
}

TEST(Untangle, AStarThatIsOnePointStays) {
  Star star = test::fan_of({{1, 1}, {1, 1}, {1, 1}});
  EXPECT_EQ(star.inversion({1, 1}, star.reference({1, 1})), 0);
  EXPECT_EQ(untangle(star, {1, 1}, Objective::power), std::nullopt);
}

/// The sum of -J over the inverted corners, and their number.
std::pair<double, int> tangle_of(const Star& star, Point p) {
  double sum = 0;
  int inverted = 0;
  for (const StarCorner& c : star.corners()) {
    sum += std::max(0.0, -cross(c.q - p, c.r - p));
    inverted += is_inverted(corner_form(p, c.q, c.r)) ? 1 : 0;
  }
  return {sum, inverted};
}

void expect_untangled(const Star& star, Point from, Point to) {
  EXPECT_LT(tangle_of(star, to), tangle_of(star, from));
  for (const StarCorner& c : star.corners()) {
    if (!is_inverted(corner_form(from, c.q, c.r))) {
      EXPECT_FALSE(is_inverted(corner_form(to, c.q, c.r))) << "a sound corner is lost";
    }
  }
}

class UntangleBy : public testing::TestWithParam<Objective> {};
INSTANTIATE_TEST_SUITE_P(Objectives, UntangleBy, testing::Values(Objective::power, Objective::thesis));

TEST_P(UntangleBy, OnlyLowersTheTangle) {
  Random random(32);
  int tangled = 0, better = 0;
  for (int i = 0; i < 500; ++i) {
    Star star = test::random_star(random, static_cast<Cells>(i % 3));
    const Point p = uniform(random, 0.3, 2) * test::random_direction(random);
    if (star.cost(p, Objective::power).valid[0]) continue;
    ++tangled;
    const auto to = untangle(star, p, GetParam());
    if (!to) continue;
    ++better;
    expect_untangled(star, p, *to);
  }
  EXPECT_GT(tangled, 250);
  EXPECT_GT(better, tangled * 9 / 10);
}

TEST(Untangle, OnlyLowersTheTangleWhereNothingMakesTheStarValid) {
  Random random(33);
  int better = 0;
  for (int i = 0; i < 500; ++i) {
    Star star = test::random_star(random, Cells::triangles);
    const StarCorner first = star.corners()[0];
    star.add(
        {first.r, first.q, first.target, first.angle});  // a corner that is sound only where the first is not
    const Point p = uniform(random, 0, 2) * test::random_direction(random);
    const auto to = untangle(star, p, Objective::power);
    if (!to) continue;
    ++better;
    expect_untangled(star, p, *to);
    EXPECT_GT(tangle_of(star, *to).second, 0);
  }
  EXPECT_GT(better, 100);
}

TEST(Untangle, BringsANodeBackInside) {
  Random random(34);
  for (int i = 0; i < 300; ++i) {
    const Star star = test::random_star(random, static_cast<Cells>(i % 3));
    const Point p = uniform(random, 1.6, 3) * test::random_direction(random);  // outside all cells
    const auto to = untangle(star, p, Objective::power);
    ASSERT_TRUE(to);
    EXPECT_TRUE(star.cost(*to, Objective::power).valid[0]);
  }
}

/// Of a star that no place makes valid: by the thesis's objective the smallest J is raised, else the sum of
/// the negative ones.
TEST(Untangle, TheObjectiveSaysWhichPlaceIsBest) {
  Random random(37);
  int other = 0;
  for (int i = 0; i < 300; ++i) {
    Star star = test::random_star(random, Cells::triangles);
    for (std::size_t k = 0; k < 3; ++k) {
      const StarCorner& c = star.corners()[k];
      star.add({c.r, c.q, c.target, c.angle});  // a corner that is sound only where this one is not
    }
    const Point p = uniform(random, 0, 2) * test::random_direction(random);
    const double reference = star.reference(p);
    const auto by_sum = untangle(star, p, Objective::power), by_cost = untangle(star, p, Objective::thesis);
    EXPECT_EQ(by_sum.has_value(), by_cost.has_value())
        << "which places are acceptable does not hang on the objective";
    if (!by_sum) continue;
    const double cost = star.nodal_cost(*by_cost, reference),
                 cost_by_sum = star.nodal_cost(*by_sum, reference);
    EXPECT_LE(cost, cost_by_sum);
    EXPECT_LE(tangle_of(star, *by_sum), tangle_of(star, *by_cost));
    other += cost < cost_by_sum ? 1 : 0;
  }
  EXPECT_GT(other, 20);
}

TEST(Untangle, LeavesValidStarsAlone) {
  Random random(35);
  for (int i = 0; i < 50; ++i)
    EXPECT_EQ(untangle(test::random_star(random, static_cast<Cells>(i % 3)), {0, 0}, Objective::power),
              std::nullopt);
}

TEST(UntanglingRule, ByHand) {
  const Star star = test::fan_of({{1, 0}, {0, 1}, {-1, 0}, {0, -1}});
  const UntanglingRule rule(star, {2, 0}, Objective::power);
  EXPECT_EQ(rule.tangle({2, 0}).inversion, 0.4);  // J is -1 twice, the mean squared edge 5
  EXPECT_EQ(rule.tangle({2, 0}).inverted, 2);
  EXPECT_TRUE(rule.accepts({1.5, 0}));
  EXPECT_TRUE(rule.accepts({0, 0}));
  EXPECT_FALSE(rule.accepts({2, 0}));
  EXPECT_FALSE(rule.accepts({3, 0}));
  EXPECT_FALSE(rule.accepts({-1.1, 0})) << "the corners on the other side are lost";
  EXPECT_TRUE(rule.accepts({1, 0})) << "two flat corners are less than two inverted ones";
  EXPECT_FALSE(UntanglingRule(star, {1, 0}, Objective::power).accepts({1, 1e-3}))
      << "one sound again, one inverted";
}

TEST(RankedPlaces, OfATangledStarTheLowestCostOfEquation34First) {
  Random random(38);
  int pairs = 0;
  for (int i = 0; i < 300; ++i) {
    const Star star = test::random_star(random, static_cast<Cells>(i % 3));
    const Point p = uniform(random, 1, 2) * test::random_direction(random);
    if (star.cost(p, Objective::thesis).valid[0]) continue;
    Star::Batch x, y;
    for (int k = 0; k < Star::batch; ++k) {
      x[k] = uniform(random, -1.5, 1.5);
      y[k] = uniform(random, -1.5, 1.5);
    }
    const std::vector<int> order = ranked_places(star, p, Objective::thesis, x, y);
    const double reference = star.reference(p);
    for (std::size_t k = 0; k + 1 < order.size(); ++k, ++pairs) {
      EXPECT_LE(star.nodal_cost({x[order[k]], y[order[k]]}, reference),
                star.nodal_cost({x[order[k + 1]], y[order[k + 1]]}, reference));
    }
  }
  EXPECT_GT(pairs, 100);
}

TEST(RankedPlaces, AreAcceptedAndBestFirst) {
  Random random(36);
  std::size_t ranked[2] = {0, 0};
  for (int i = 0; i < 300; ++i) {
    const Star star = test::random_star(random, static_cast<Cells>(i % 3));
    const Point p = uniform(random, 0, 1.5) * test::random_direction(random);
    const bool valid = star.cost(p, Objective::power).valid[0];
    Star::Batch x, y;
    for (int k = 0; k < Star::batch; ++k) {
      x[k] = uniform(random, -1, 1);
      y[k] = uniform(random, -1, 1);
    }
    const std::vector<int> order = ranked_places(star, p, Objective::power, x, y);
    ranked[valid ? 1 : 0] += order.size();
    std::vector<char> listed(Star::batch, 0);
    for (const int k : order) listed[k] = 1;
    const Acceptance acceptance(star.cost(p, Objective::power));
    const UntanglingRule rule(star, p, Objective::power);
    const auto place = [&](int k) { return Point{x[k], y[k]}; };
    for (int k = 0; k < Star::batch; ++k) {
      const bool accepted =
          valid ? acceptance.accepts(star.cost(place(k), Objective::power), 0) : rule.accepts(place(k));
      EXPECT_EQ(accepted, listed[k] != 0);
    }
    for (std::size_t k = 0; k + 1 < order.size(); ++k) {
      const Point a = place(order[k]), b = place(order[k + 1]);
      EXPECT_TRUE(valid ? star.cost(a, Objective::power).objective[0] <=
                              star.cost(b, Objective::power).objective[0]
                        : !(rule.tangle(b) < rule.tangle(a)));
    }
  }
  EXPECT_GT(ranked[0], 100U);
  EXPECT_GT(ranked[1], 20U);
}

}  // namespace
}  // namespace quadloop::smoother
