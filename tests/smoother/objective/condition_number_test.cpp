// The weighted condition number and its cost, against values by hand and against the matrices of the thesis.
#include "smoother/objective/condition_number.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <numeric>

#include "tests/smoother/rounding.hpp"
#include "tests/smoother/stars.hpp"

namespace quadloop::smoother {
namespace {

using test::Random;
using test::rounding;
using test::uniform;

CornerForm corner_of(Point e1, Point e2) { return corner_form({0, 0}, e1, e2); }
double cost_of(Point e1, Point e2, const CornerTarget& target) {
  return corner_cost(corner_of(e1, e2), target, 1);
}

Point turned(Point v, double radians) {
  return {std::cos(radians) * v.x - std::sin(radians) * v.y,
          std::sin(radians) * v.x + std::cos(radians) * v.y};
}

Eigen::Matrix2d columns(Point e1, Point e2) {
  Eigen::Matrix2d matrix;
  matrix << e1.x, e2.x, e1.y, e2.y;
  return matrix;
}

/// Eq. 3.3 as it is written.
double by_matrices(const Eigen::Matrix2d& a, const Eigen::Matrix2d& w) {
  return (a * w.inverse()).norm() * (w * a.inverse()).norm() / 2;
}

/// Two edges that turn left, not too flat.
std::array<Point, 2> random_edges(Random& random) {
  const Point e1 = uniform(random, 0.2, 3) * test::random_direction(random);
  return {e1, uniform(random, 0.2, 3) *
                  turned((1 / length(e1)) * e1, uniform(random, 0.1, std::numbers::pi - 0.1))};
}

TEST(CornerForm, HoldsTheProductsOfTheEdges) {
  const CornerForm form = corner_form({1, 1}, {4, 2}, {2, 6});
  EXPECT_EQ(form.uu, 10);
  EXPECT_EQ(form.uv, 8);
  EXPECT_EQ(form.vv, 26);
  EXPECT_EQ(form.jacobian, 14);
}

TEST(CellCost, OfACellThatIsOnePointIsThatOfAFlatOne) {
  const Point p{0.3, -7};
  EXPECT_EQ(cell_cost<3>({p, p, p}, ideal_targets<3>()), 1);
  EXPECT_EQ(cell_cost<4>({p, p, p, p}, ideal_targets<4>()), 1);
  EXPECT_EQ(cell_cost<3>({p, p + Point{1, 0}, p + Point{2, 0}}, ideal_targets<3>()), 1);
}

TEST(ConditionNumber, EquilateralTriangle) {
  const CornerForm form = corner_of({2, 0}, {1, std::numbers::sqrt3});
  EXPECT_NEAR(condition_number(form, equilateral_target()), 1, rounding);
  EXPECT_NEAR(corner_cost(form, equilateral_target(), 1), 0, rounding);
}

TEST(ConditionNumber, RightTriangles) {
  EXPECT_NEAR(condition_number(corner_of({1, 0}, {0, 1}), equilateral_target()), 2 / std::numbers::sqrt3,
              rounding);
  EXPECT_NEAR(cost_of({1, 0}, {0, 1}, equilateral_target()), std::pow(1 - std::numbers::sqrt3 / 2, 2),
              rounding);
  EXPECT_NEAR(condition_number(corner_of({1, 0}, {0, 0.5}), equilateral_target()), 2.5 / std::numbers::sqrt3,
              rounding);
}

TEST(ConditionNumber, CornerOfARectangle) {
  EXPECT_NEAR(condition_number(corner_of({1, 0}, {0, 1}), right_angle_target()), 1, rounding);
  EXPECT_NEAR(condition_number(corner_of({2, 0}, {0, 1}), right_angle_target()), 1.25, rounding);
  EXPECT_NEAR(cost_of({2, 0}, {0, 1}, right_angle_target()), 0.04, rounding);
}

TEST(CornerCost, OfInvertedCorners) {
  EXPECT_EQ(corner_cost(corner_of({1, 0}, {0, -1}), equilateral_target(), 4), 1.25);
  EXPECT_EQ(corner_cost(corner_of({3, 0}, {1, -2}), right_angle_target(), 2), 4);
  EXPECT_EQ(cost_of({1, 0}, {2, 0}, equilateral_target()), 1) << "flat";
  EXPECT_EQ(cost_of({0, 0}, {2, 0}, equilateral_target()), 1) << "of two nodes in one place";
}

TEST(CornerCost, OfTheFlattestCorners) {
  EXPECT_TRUE(is_inverted(corner_of({1e3, 0}, {2, 1.9e-12})));
  EXPECT_FALSE(is_inverted(corner_of({1e3, 0}, {2, 2.1e-12})));
  EXPECT_EQ(cost_of({1e3, 0}, {2, 1.9e-12}, equilateral_target()), 1);
  EXPECT_LT(cost_of({1e3, 0}, {2, 1e-6}, equilateral_target()), 1);
}

TEST(CornerTarget, OfTheIdealShapes) {
  const CornerTarget triangle = corner_target({1, 0}, {0.5, std::numbers::sqrt3 / 2}),
                     square = corner_target({0, 3}, {-3, 0});
  EXPECT_NEAR(triangle.g11, equilateral_target().g11, rounding);
  EXPECT_NEAR(triangle.g12, equilateral_target().g12, rounding);
  EXPECT_NEAR(triangle.g22, equilateral_target().g22, rounding);
  EXPECT_NEAR(square.g11, right_angle_target().g11, rounding);
  EXPECT_NEAR(square.g12, right_angle_target().g12, rounding);
  EXPECT_NEAR(square.g22, right_angle_target().g22, rounding);
}

TEST(CornerTarget, CostsNothingForItsShapeTurnedAndScaled) {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const auto [w1, w2] = random_edges(random);
    const double turn = uniform(random, 0, 7), scale = uniform(random, 0.01, 100);
    EXPECT_NEAR(cost_of(scale * turned(w1, turn), scale * turned(w2, turn), corner_target(w1, w2)), 0,
                rounding);
    EXPECT_GT(cost_of(w1, 1.1 * w2, corner_target(w1, w2)), 1e-6) << "another shape";
  }
}

TEST(CornerTarget, AgreesWithTheMatrices) {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const auto [e1, e2] = random_edges(random);
    const auto [w1, w2] = random_edges(random);
    const double expected = by_matrices(columns(e1, e2), columns(w1, w2));
    EXPECT_NEAR(condition_number(corner_of(e1, e2), corner_target(w1, w2)), expected, 1e-10 * expected);
    EXPECT_NEAR(cost_of(e1, e2, corner_target(w1, w2)), std::pow(1 - 1 / expected, 2), 1e-10);
  }
}

TEST(CornerTarget, SeenFromAllThreeNodes) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const auto [e1, e2] = random_edges(random);
    const auto [w1, w2] = random_edges(random);
    const Point p{0.3, -0.2}, q = p + e1, r = p + e2;
    const CornerTarget from_p = corner_target(w1, w2), from_q = seen_from_next(from_p),
                       from_r = seen_from_next(from_q);
    const double expected = condition_number(corner_form(p, q, r), from_p);
    EXPECT_NEAR(condition_number(corner_form(q, r, p), from_q), expected, 1e-10 * expected);
    EXPECT_NEAR(condition_number(corner_form(r, p, q), from_r), expected, 1e-10 * expected);
    EXPECT_NEAR(seen_from_next(from_r).g12, from_p.g12, 1e-10 * (from_p.g11 + from_p.g22))
        << "three times round";
  }
}

TEST(StretchedTargets, CostNothingForTheStretchedCell) {
  Random random(4);
  for (int i = 0; i < 100; ++i) {
    const auto [w1, w2] = random_edges(random);
    const Point p{1, 2}, a = p + 3 * w1, c = p + 3 * w2;
    EXPECT_NEAR(cell_cost<3>({p, a, c}, stretched_targets<3>(w1, w2)), 0, rounding);
    EXPECT_NEAR(cell_cost<4>({p, a, a + c - p, c}, stretched_targets<4>(w1, w2)), 0, rounding);
    EXPECT_GT(cell_cost<4>({p, a, a + 0.5 * (c - p), c}, stretched_targets<4>(w1, w2)), 1e-4);
  }
}

TEST(CellCost, IsThatOfTheWorstCorner) {
  EXPECT_NEAR(cell_cost<3>({Point{0, 0}, {1, 0}, {0.5, std::numbers::sqrt3 / 2}}, ideal_targets<3>()), 0,
              rounding);
  EXPECT_NEAR(cell_cost<3>({Point{0, 0}, {1, 0}, {0, 1}}, ideal_targets<3>()),
              std::pow(1 - std::numbers::sqrt3 / 2, 2), rounding);
  EXPECT_NEAR(cell_cost<4>({Point{0, 0}, {2, 0}, {2, 1}, {0, 1}}, ideal_targets<4>()), 0.04, rounding);
  // A trapezium with the condition numbers 5/3, 7/3, 3 and 1 at its corners.
  EXPECT_NEAR(cell_cost<4>({Point{0, 0}, {3, 0}, {1, 1}, {0, 1}}, ideal_targets<4>()), 4.0 / 9, rounding);
}

TEST(CellCost, OfInvertedCells) {
  // Clockwise unit square: J = -1 at each corner, the mean of the squared edges is 1.
  EXPECT_EQ(cell_cost<4>({Point{0, 0}, {0, 1}, {1, 1}, {1, 0}}, ideal_targets<4>()), 2);
  // A quad with one corner pushed beyond its diagonal is inverted there alone.
  EXPECT_GT(cell_cost<4>({Point{0, 0}, {1, 0}, {0.2, 0.2}, {0, 1}}, ideal_targets<4>()), 1);
  EXPECT_LT(cell_cost<4>({Point{0, 0}, {1, 0}, {0.8, 0.8}, {0, 1}}, ideal_targets<4>()), 1);
}

}  // namespace
}  // namespace quadloop::smoother
