// Rational Bézier curves over chords: points, halves, bounds, symmetry under reversal.
#include "mesher/geometry/curve.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "mesher/geometry/curve_parts.hpp"

namespace quadloop {
namespace {

/// A quarter of the circle of radius 2 around (3, -1), from its right to its top.
CurvedSegment quarter() { return {{5, -1}, {{{5, 1}}, {1, std::sqrt(0.5), 1}}, {3, 1}}; }

double distance_from_circle(Point p) { return std::abs(length(p - Point{3, -1}) - 2); }

CurvedSegment random_cubic(std::mt19937& random) {
  std::uniform_real_distribution<double> bend(-0.05, 0.05);
  const Point a{bend(random) * 100, bend(random) * 100}, b = a + Point{1, bend(random)};
  return {a, {{a + Point{0.3, bend(random)}, a + Point{0.7, bend(random)}}, {}, 0}, b};
}

TEST(Curve, QuarterOfACircle) {
  constexpr int points = 64;
  for (int i = 0; i <= points; ++i) {
    const Point p = point_at(quarter(), i / double{points});
    EXPECT_LT(distance_from_circle(p), 2e-15);
  }
  EXPECT_EQ(direction_at_start(quarter()), (Point{0, 1}));
  EXPECT_EQ(direction_at_end(quarter()), (Point{-1, 0}));
  EXPECT_NEAR(turning_of_hull(quarter()), 90, 1e-12);
  EXPECT_NEAR(height_of_hull(quarter()), std::sqrt(2.0), 1e-15);
}

TEST(Curve, HalvesAreTheCurve) {
  const auto [first, second] = halves(quarter());
  EXPECT_EQ(first.to, second.from);
  for (int i = 0; i <= 16; ++i) {
    const double t = i / 16.0;
    EXPECT_LT(length(point_at(first, t) - point_at(quarter(), t / 2)), 1e-14);
    EXPECT_LT(length(point_at(second, t) - point_at(quarter(), 0.5 + t / 2)), 1e-14);
  }
  EXPECT_LT(turning_of_hull(first), 45 + 1e-12);
}

TEST(Curve, PartsAtAPointAreTheCurve) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(0.01, 0.99);
  for (int i = 0; i < 200; ++i) {
    const CurvedSegment curve = i % 2 == 0 ? quarter() : random_cubic(random);
    const Point p = curve.from + share(random) * (curve.to - curve.from);
    const auto [first, second] = parts_at(curve, p);
    EXPECT_EQ(first.from, curve.from);
    EXPECT_EQ(first.to, above_chord(curve, p).point);
    EXPECT_EQ(second.from, first.to);
    EXPECT_EQ(second.to, curve.to);
    for (int k = 0; k <= 16; ++k) {
      for (const CurvedSegment& part : {first, second}) {
        const Point at = point_at(part, k / 16.0);
        EXPECT_LT(length(at - above_chord(curve, at).point), 5e-15);
      }
    }
  }
}

TEST(Curve, HalvesOfTheReversedCurveAreTheReversedHalves) {
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const CurvedSegment curve = random_cubic(random);
    const auto [first, second] = halves(curve);
    const auto [back_first, back_second] = halves(reversed(curve));
    EXPECT_EQ(back_first.to, first.to);
    EXPECT_EQ(back_first.curve, reversed(second.curve));
    EXPECT_EQ(back_second.curve, reversed(first.curve));
  }
}

TEST(Curve, PointAboveChord) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0, 1);
  for (int i = 0; i < 200; ++i) {
    const CurvedSegment curve = random_cubic(random);
    const Point chord = curve.to - curve.from, p = curve.from + share(random) * chord;
    const CurvePoint above = above_chord(curve, p);
    EXPECT_LT(std::abs(dot(above.point - p, chord)), 1e-15);
    EXPECT_EQ(above.point, above_chord(reversed(curve), p).point);
    // It is on the curve, and the curve runs in its direction there.
    const CurvePoint again = above_chord(curve, above.point);
    EXPECT_LT(length(again.point - above.point), 2e-15);
    const Point ahead = above_chord(curve, p + 1e-6 * chord).point - above.point;
    EXPECT_LT(std::abs(cross(ahead, above.direction)), 1e-10 * length(chord));
    EXPECT_NEAR(length(above.direction), 1, 1e-15);
  }
}

TEST(Curve, MirrorImagesHaveMirroredPoints) {
  std::mt19937 random(7);
  const auto image = [](Point p) { return Point{p.x, -p.y}; };
  for (int i = 0; i < 200; ++i) {
    const CurvedSegment curve = random_cubic(random);
    CurvedSegment mirrored = reversed(curve);
    mirrored.from = image(mirrored.from);
    mirrored.to = image(mirrored.to);
    for (Point& p : mirrored.curve.inner) p = image(p);
    const Point p = curve.from + 0.3 * (curve.to - curve.from);
    EXPECT_EQ(above_chord(mirrored, image(p)).point, image(above_chord(curve, p).point));
  }
}

TEST(Curve, BeyondTheEndsTheNearerEndCounts) {
  EXPECT_EQ(above_chord(quarter(), {6, -3}).point, (Point{5, -1}));
  EXPECT_EQ(above_chord(quarter(), {1, 2}).point, (Point{3, 1}));
  EXPECT_EQ(above_chord(quarter(), {5, -1}).point, (Point{5, -1}));
}

TEST(Curve, AStraightSegmentKeepsPoints) {
  const CurvedSegment line{{0, 0}, {}, {2, 1}};
  EXPECT_EQ(above_chord(line, {0.7, 0.35}).point, (Point{0.7, 0.35}));
  EXPECT_EQ(height_of_hull(line), 0);
  EXPECT_EQ(turning_of_hull(line), 0);
}

}  // namespace
}  // namespace quadloop
