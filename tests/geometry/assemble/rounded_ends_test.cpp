// Ends that rounding has parted are joined; no others are.
#include "mesher/geometry/assemble/rounded_ends.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "mesher/geometry/assemble/curved_chain.hpp"
#include "tests/geometry/outlines.hpp"

namespace quadloop {
namespace {

/// The smallest step up from a coordinate of size 1, so many times.
double ulps(int count) { return count * std::numeric_limits<double>::epsilon(); }

Chain chain(bool open, std::vector<Point> points) { return {"wall", open, std::move(points), "file:1"}; }

struct Repaired {
  explicit Repaired(std::vector<Chain> given, double share = 0) : chains{std::move(given)} {
    join_rounded_ends(chains, share, warnings);
  }
  std::vector<Chain> chains;
  std::vector<std::string> warnings;
};

TEST(RoundedEnds, TheLaterEndMovesOntoTheEarlier) {
  const Repaired both({chain(true, {{0, 0}, {1, 0}}), chain(true, {{1 + ulps(5), ulps(9)}, {0.5, 0.5}})});
  EXPECT_EQ(both.chains[0].points, (std::vector<Point>{{0, 0}, {1, 0}}));
  EXPECT_EQ(both.chains[1].points, (std::vector<Point>{{1, 0}, {0.5, 0.5}}));
  EXPECT_EQ(both.warnings.size(), 1U);
}

TEST(RoundedEnds, WhatIsFartherApartStays) {
  for (const double gap : {ulps(17), ulps(1000)}) {
    const Repaired apart({chain(true, {{0, 0}, {1, 0}}), chain(true, {{1, gap}, {0.5, 0.5}})});
    EXPECT_EQ(apart.chains[1].points.front(), (Point{1, gap}));
    EXPECT_TRUE(apart.warnings.empty());
  }
}

TEST(RoundedEnds, AShareOfTheExtentMayBeAllowed) {
  const std::vector<Chain> given{chain(true, {{0, 0}, {4, 0}}), chain(true, {{4, 3e-9}, {0.5, 0.5}})};
  EXPECT_EQ(Repaired(given, 1e-9).chains[1].points.front(), (Point{4, 0}));
  EXPECT_EQ(Repaired(given, 1e-9).warnings.size(), 1U);
  EXPECT_EQ(Repaired(given, 5e-10).chains[1].points.front(), (Point{4, 3e-9}));
}

TEST(RoundedEnds, WhatIsThereTwiceStaysOnce) {
  const Repaired lines(
      {chain(true, {{0, 0}, {1, 0}}), chain(true, {{1, 0}, {1, 1}}), chain(true, {{1, 0}, {0, 0}})});
  EXPECT_EQ(lines.chains.size(), 2U);
  ASSERT_EQ(lines.warnings.size(), 1U);
  EXPECT_NE(lines.warnings[0].find("dropped 1 line"), std::string::npos) << lines.warnings[0];
  EXPECT_EQ(Repaired({chain(false, {{0, 0}, {1, 0}, {1, 1}}), chain(false, {{1, 1}, {1, 0}, {0, 0}})})
                .chains.size(),
            1U);
  Chain other = chain(false, {{0, 0}, {1, 0}, {1, 1}});
  other.name = "other";
  EXPECT_EQ(Repaired({chain(false, {{0, 0}, {1, 0}, {1, 1}}), other}).chains.size(), 2U);
}

Chain of_drawing(bool open, std::vector<Point> points) {
  Chain line = chain(open, std::move(points));
  line.directed = false;
  return line;
}

TEST(RoundedEnds, LinesOverAPartOfAPolylineAreDropped) {
  const Chain square = of_drawing(false, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  const Repaired one({of_drawing(true, {{1, 0}, {0, 0}}), square});
  ASSERT_EQ(one.chains.size(), 1U);
  EXPECT_EQ(one.chains[0].points, square.points);
  ASSERT_EQ(one.warnings.size(), 1U);
  EXPECT_NE(one.warnings[0].find("dropped 1 line that is there twice"), std::string::npos) << one.warnings[0];
  EXPECT_EQ(Repaired({square, of_drawing(true, {{0, 1}, {0, 0}, {1, 0}}), of_drawing(true, {{0, 0}, {0, 1}})})
                .chains.size(),
            1U)
      << "across the point where the loop begins";
  EXPECT_EQ(Repaired({square, of_drawing(true, {{0, 0}, {1, 1}})}).chains.size(), 2U) << "a diagonal";
  EXPECT_EQ(Repaired({square, of_drawing(true, {{0, 0}, {1, 0}, {2, 0}})}).chains.size(), 2U)
      << "a part repeats";
  EXPECT_EQ(Repaired({square, chain(true, {{0, 0}, {1, 0}})}).chains.size(), 2U) << "directed";
  Chain other = of_drawing(true, {{0, 0}, {1, 0}});
  other.name = "other";
  EXPECT_EQ(Repaired({square, other}).chains.size(), 2U);
}

TEST(RoundedEnds, PiecesOfACurvedLoopAreDropped) {
  Chain loop = of_drawing(true, {{1, 0}});
  append_arc(loop, {{0, 0}, {1, 0}, {0, 1}, 0, std::numbers::pi}, Point{-1, 0});
  Chain upper = loop, straight = of_drawing(true, loop.points);
  append_arc(loop, {{0, 0}, {-1, 0}, {0, -1}, 0, std::numbers::pi}, Point{1, 0});
  loop.points.pop_back();
  loop.open = false;
  EXPECT_EQ(Repaired({upper, loop}).chains.size(), 1U);
  EXPECT_EQ(Repaired({straight, loop}).chains.size(), 2U);
}

/// A half circle about the origin, above (or below) it.
Chain half_circle(double x, double height) {
  Chain half = chain(true, {{x, 0}});
  append_arc(half, {{0, 0}, {x, 0}, {0, height}, 0, std::numbers::pi}, Point{-x, 0});
  return half;
}

TEST(RoundedEnds, CurvesThatAreThereTwiceStayOnce) {
  Chain backwards = half_circle(1, 1);
  std::ranges::reverse(backwards.points);
  backwards.curves = reversed(std::move(backwards.curves));
  const Chain upper = half_circle(1, 1), lower = half_circle(1, -1), flat = half_circle(1, 0.5);
  EXPECT_EQ(Repaired({upper, lower, backwards}).chains.size(), 2u);
  EXPECT_EQ(Repaired({upper, flat}).chains.size(), 2u) << "the same ends";
  Chain other_shape = upper;
  other_shape.curves[1].inner[0].y *= 2;
  EXPECT_EQ(Repaired({upper, other_shape}).chains.size(), 2u) << "the same points";
  EXPECT_EQ(Repaired({upper, chain(true, upper.points)}).chains.size(), 2u) << "straight";
  Chain loop = upper;
  append_arc(loop, {{0, 0}, {-1, 0}, {0, -1}, 0, std::numbers::pi}, Point{1, 0});
  loop.points.pop_back();
  loop.open = false;
  Chain other = loop;
  std::ranges::rotate(other.points, other.points.begin() + 1);
  std::ranges::rotate(other.curves, other.curves.begin() + 1);
  EXPECT_EQ(Repaired({loop, other}).chains.size(), 1u);
  std::ranges::reverse(other.points);
  other.curves = reversed(std::move(other.curves));
  std::ranges::rotate(other.curves, other.curves.begin() + 1);  // the first segment begins at the first point
  EXPECT_EQ(Repaired({loop, other}).chains.size(), 1u);
}

TEST(RoundedEnds, RoundingGrowsWithTheLargestCoordinate) {
  const Repaired both({chain(true, {{0, 0}, {1, 0}}), chain(true, {{1, ulps(1000)}, {100, 0.5}})});
  EXPECT_EQ(both.chains[1].points.front(), (Point{1, 0}));
  const Repaired infinite({chain(true, {{0, 0}, {1, 0}}),
                           chain(true, {{1, ulps(1000)}, {std::numeric_limits<double>::infinity(), 0.5}})});
  EXPECT_EQ(infinite.chains[1].points.front(), (Point{1, ulps(1000)}))
      << "it is refused later, and is no measure";
}

TEST(RoundedEnds, ThreeEndsAreNotGuessedAt) {
  const std::vector<Chain> given{chain(true, {{0, 0}, {1, 0}}), chain(true, {{1, ulps(2)}, {0, 1}}),
                                 chain(true, {{1, ulps(4)}, {0.5, 1}})};
  const std::string said = test::refusal([&] { const Repaired three(given); });
  EXPECT_NE(
      said.find("file:1: boundary 'wall': 3 chains end within 3.6e-15 of (1, 0) ('wall', 'wall', 'wall')"),
      std::string::npos)
      << said;
}

TEST(RoundedEnds, AnEndThatMeetsAnotherExactlyIsNotLoose) {
  const std::string said = test::refusal([] {
    const Repaired met(
        {chain(true, {{0, 0}, {1, 0}}), chain(true, {{1, 0}, {1, 1}}), chain(true, {{1, ulps(2)}, {0, 1}})});
  });
  EXPECT_NE(said.find("3 chains end within"), std::string::npos) << said;
}

TEST(RoundedEnds, AChainClosesOnItselfUnlessTwoPointsWouldRemain) {
  const Repaired loop({chain(true, {{0, 0}, {1, 0}, {0, 1}, {ulps(1), ulps(1)}})});
  EXPECT_EQ(loop.chains[0].points.back(), (Point{0, 0}));
  const Repaired flat({chain(true, {{0, 0}, {1, 0}, {ulps(1), ulps(1)}})});
  EXPECT_EQ(flat.chains[0].points.back(), (Point{ulps(1), ulps(1)}));
}

TEST(RoundedEnds, PointsTooNearToTheOneBeforeAreDropped) {
  const Repaired closed({chain(false, {{0, 0}, {1, 0}, {1, ulps(3)}, {0, 1}, {0, ulps(1)}, {ulps(2), 0}})});
  EXPECT_EQ(closed.chains[0].points, (std::vector<Point>{{0, 0}, {1, 0}, {0, 1}}));
  EXPECT_EQ(closed.warnings.size(), 1U);
  const Repaired open({chain(true, {{0, 0}, {0, ulps(2)}, {1, 0}, {1, ulps(3)}})});
  EXPECT_EQ(open.chains[0].points, (std::vector<Point>{{0, 0}, {1, ulps(3)}})) << "ends stay";
}

TEST(RoundedEnds, NothingIsWellWithNothing) {
  EXPECT_TRUE(Repaired({}).warnings.empty());
  EXPECT_TRUE(Repaired({chain(true, {}), chain(false, {{1, 1}})}).warnings.empty());
}

}  // namespace
}  // namespace quadloop
