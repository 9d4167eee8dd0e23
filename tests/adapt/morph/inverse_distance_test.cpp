#include "adapt/morph/inverse_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

namespace quadloop::adapt {
namespace {

constexpr int circle_nodes = 200, frame_nodes = 80;

MotionSource source(const RigidMotion& motion, double width) {
  return {motion.from, width, linear_motion(motion)};
}

/// A unit circle that does what it is told, in a square of half width 8 that stays.
std::vector<MotionSource> circle_in_square(const std::function<RigidMotion(Point)>& motion) {
  std::vector<MotionSource> sources;
  for (int k = 0; k < circle_nodes; ++k) {
    const double angle = 2 * std::numbers::pi * k / circle_nodes;
    sources.push_back(
        source(motion({std::cos(angle), std::sin(angle)}), 2 * std::numbers::pi / circle_nodes));
  }
  for (int k = 0; k < frame_nodes; ++k) {
    const double t = -8 + 16.0 * k / frame_nodes;
    for (const Point p : {Point{t, -8}, {8, t}, {-t, 8}, {-8, -t}})
      sources.push_back(source({p, p, 0}, 16.0 / frame_nodes));
  }
  return sources;
}

RigidMotion turned_about_origin(Point p, double angle, Point shift) {
  return {p,
          {std::cos(angle) * p.x - std::sin(angle) * p.y + shift.x,
           std::sin(angle) * p.x + std::cos(angle) * p.y + shift.y},
          angle};
}

TEST(InverseDistance, NothingMovesWhereNothingMoves) {
  const InverseDistance field(circle_in_square([](Point p) { return RigidMotion{p, p, 0}; }), 2);
  for (const Point p : {Point{1.001, 0}, {2, 3}, {-7.9, 7.9}})
    EXPECT_EQ(field.displacement(p), (Point{0, 0}));
}

TEST(InverseDistance, ABodyThatTurnsTakesItsSurroundingsAlong) {
  const double angle = 0.3;
  const auto turn = [&](Point p) { return turned_about_origin(p, angle, {0.2, -0.1}); };
  const InverseDistance field(circle_in_square(turn), 2);
  const Point near{1.02, 0}, wanted = turn(near).to - near, found = field.displacement(near);
  EXPECT_NEAR(found.x, wanted.x, 2e-4);
  EXPECT_NEAR(found.y, wanted.y, 2e-4);
  EXPECT_LT(length(field.displacement({7.9, 0.1})), 0.02 * length(turn({7.9, 0.1}).to - Point{7.9, 0.1}));
}

TEST(InverseDistance, SourcesFarAwayCountAsOneWithLittleLoss) {
  const auto swell = [](Point p) { return RigidMotion{p, 1.1 * p, 0.05 * p.x}; };
  const std::vector<MotionSource> sources = circle_in_square(swell);
  const double largest = 0.1;
  const InverseDistance field(sources, 2);
  for (const Point p : {Point{3, 0}, {0, 5}, {-4, -4}}) {
    Point sum;
    double weights = 0;
    for (const MotionSource& s : sources) {
      const double r = length(p - s.place), weight = s.width * (1 + 4 / (r * r)) / (r * r * r);
      sum = sum + weight * s.motion.displacement(p - s.place);
      weights += weight;
    }
    const Point direct = (1 / weights) * sum;
    EXPECT_LT(length(field.displacement(p) - direct), 0.02 * largest) << p.x << ", " << p.y;
  }
}

TEST(InverseDistance, GradientsAreTheTranspose) {
  const auto swell = [](Point p) { return RigidMotion{p, 1.1 * p, 0.05 * p.x}; };
  const std::vector<MotionSource> sources = circle_in_square(swell);
  const InverseDistance field(sources, 2);
  std::vector<LinearMotion> of_means(field.mean_count());
  double gain = 0;
  for (const Point p : {Point{3, 0}, {0, 5}, {-4, -4}, {1.01, 0.02}}) {
    const Point g{p.y - 1, 2 * p.x};
    gain += dot(field.displacement(p), g);
    field.add_gradient(p, g, [&](std::int32_t k, const LinearMotion& part) { of_means[k] += part; });
  }
  const std::vector<LinearMotion> gradient = field.gradient_of_sources(of_means);
  double of_sources = 0;
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const LinearMotion& motion = sources[s].motion;
    of_sources += dot(gradient[s].shift, motion.shift) + gradient[s].versed * motion.versed +
                  gradient[s].sine * motion.sine;
  }
  EXPECT_NEAR(of_sources, gain, 1e-13);
  EXPECT_GT(std::abs(gain), 0.1);
}

TEST(LinearMotion, DoesWhatTheTurnDoes) {
  const RigidMotion motion{{1, 1}, {1.5, 0.8}, 0.7};
  const Point p{2, 3}, moved = p + linear_motion(motion).displacement(p - motion.from);
  EXPECT_LT(length(moved - motion.moved(p)), 1e-14);
}

TEST(RigidMotion, TurnsAboutItsOwnPoint) {
  const RigidMotion quarter{{1, 1}, {4, 1}, std::numbers::pi / 2};
  const Point moved = quarter.moved({2, 1});
  EXPECT_NEAR(moved.x, 4, 1e-15);
  EXPECT_NEAR(moved.y, 2, 1e-15);
  EXPECT_EQ(quarter.part(0).moved({2, 1}), (Point{2, 1}));
}

}  // namespace
}  // namespace quadloop::adapt
