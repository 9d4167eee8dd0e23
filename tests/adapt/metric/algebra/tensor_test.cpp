// Metrics: what they measure, interpolated, intersected, grown.
#include "adapt/metric/algebra/tensor.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace quadloop::adapt {
namespace {

Metric stretched(double along, double across, double degrees) {
  const double turn = degrees * std::acos(-1.0) / 180;
  return Metric{
      symmetric_of({1 / (across * across), 1 / (along * along), {-std::sin(turn), std::cos(turn)}})};
}
Point at(double degrees) {
  const double turn = degrees * std::acos(-1.0) / 180;
  return {std::cos(turn), std::sin(turn)};
}

TEST(Metric, MeasuresEdgesInItsSizes) {
  const Metric m = stretched(4, 0.5, 30);
  EXPECT_NEAR(squared_length(m, 4 * at(30)), 1, 1e-12);
  EXPECT_NEAR(squared_length(m, 0.5 * at(120)), 1, 1e-12);
  EXPECT_NEAR(density_of(m), 1 / (4 * 0.5), 1e-12);
  EXPECT_NEAR(length_between(isotropic(2), isotropic(2), {6, 0}), 3, 1e-12);
  // Sizes from 1 to 2 in geometric progression over a way of 1: the integral of 2^-s.
  EXPECT_NEAR(length_between(isotropic(1), isotropic(2), {0, 1}), 0.5 / std::log(2), 1e-12);
}

TEST(Metric, IsItsLogarithmsExponential) {
  for (const double ratio : {0.02, 1.0, 100.0}) {
    const Metric m = stretched(ratio, 0.01, 77), back = exp_of(log_of(m));
    EXPECT_NEAR(back.xx / m.xx, 1, 1e-6) << ratio;
    EXPECT_NEAR(squared_length(back, ratio * at(77)), 1, 1e-4) << ratio;
  }
  // Half way between sizes of 1 and of 4 it is 2.
  const LogMetric middle{0.5 * (log_of(isotropic(1)) + log_of(isotropic(4)))};
  EXPECT_NEAR(exp_of(middle).xx, 0.25, 1e-12);
}

TEST(Metric, IntersectionAsksForTheSmallerSizes) {
  const Metric a = stretched(10, 0.1, 20), b = stretched(3, 0.3, 75);
  const Metric both = intersection(a, b), turned = intersection(b, a);
  for (double degrees = 0; degrees < 180; degrees += 7) {
    const double of_both = squared_length(both, at(degrees));
    EXPECT_GE(of_both, 0.999999 * squared_length(a, at(degrees)));
    EXPECT_GE(of_both, 0.999999 * squared_length(b, at(degrees)));
    EXPECT_NEAR(of_both, squared_length(turned, at(degrees)), 1e-6 * of_both);
  }
  EXPECT_EQ(intersection(isotropic(1), isotropic(2)), isotropic(1));
  EXPECT_NEAR(density_of(intersection(stretched(2, 1, 0), stretched(2, 1, 90))), 1, 1e-12);
}

TEST(Metric, GrowsWithTheWay) {
  const Metric grown_once = grown(isotropic(1), {2, 0}, 0.25);
  EXPECT_NEAR(1 / std::sqrt(grown_once.xx), 1 + 0.25 * 2, 1e-12) << "h + slope d";
  const Metric thin = stretched(1, 0.01, 0), later = grown(thin, {0, 1}, 0.25);
  EXPECT_GT(thin.yy / thin.xx, later.yy / later.xx) << "it becomes rounder";
  EXPECT_LT(later.yy, thin.yy);
  EXPECT_LT(later.xx, thin.xx);
}

TEST(Metric, QualityIsThatOfTheEquilateralTriangleInIt) {
  const double height = std::sqrt(0.75);
  EXPECT_NEAR(quality_in(isotropic(0.3), {0, 0}, {1, 0}, {0.5, height}), 1, 1e-12);
  EXPECT_NEAR(quality_in(stretched(10, 1, 0), {0, 0}, {10, 0}, {5, height}), 1, 1e-12);
  EXPECT_LT(quality_in(isotropic(1), {0, 0}, {10, 0}, {5, height}), 0.2);
  EXPECT_LT(quality_in(isotropic(1), {0, 0}, {0, 1}, {1, 0}), 0) << "turned over";
}

}  // namespace
}  // namespace quadloop::adapt
