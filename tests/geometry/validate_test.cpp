#include "mesher/geometry/validate.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/geometry/assemble/join_chains.hpp"
#include "mesher/geometry/meeting_pairs.hpp"
#include "tests/geometry/outlines.hpp"

namespace quadloop {
namespace {

using test::closed;
using test::refusal;
using test::reversed;
using test::square;

std::string refused(const std::vector<Chain>& chains) {
  return refusal([&] { validate(join_chains(chains)); });
}

void expect_all_in(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' is not in: " << message;
}

TEST(Validate, NamesWhereABoundaryCrossesItself) {
  expect_all_in(refused({closed("bow", {{0, 0}, {2, 2}, {2, 0}, {0, 2}})}),
                {"test:bow", "'bow'", "(1, 1)", "cross"});
}

TEST(Validate, NamesBothBoundariesThatMeet) {
  expect_all_in(refused({square("one", {0, 0}, 2), square("two", {2, 2}, 1)}),
                {"'one'", "'two'", "(2, 1)", "1 more"});
}

TEST(Validate, RefusesTouchingAtAVertex) {
  expect_all_in(refused({square("one", {0, 0}, 1), square("two", {2, 2}, 1)}), {"'one'", "'two'", "(1, 1)"});
}

TEST(Validate, RefusesTouchingAtASide) {
  expect_all_in(refused({square("one", {0, 0}, 1), closed("two", {{1, 0}, {2, -1}, {2, 1}})}), {"(1, 0)"});
}

TEST(Validate, RefusesAVertexVisitedTwice) {
  expect_all_in(refused({closed("eight", {{0, 0}, {1, 1}, {2, 0}, {2, 2}, {1, 1}, {0, 2}})}), {"(1, 1)"});
}

TEST(Validate, RefusesASpikeOfZeroWidth) {
  expect_all_in(refused({closed("spike", {{0, 0}, {4, 0}, {4, 2}, {8, 2}, {4, 2}, {4, 4}, {0, 4}})}),
                {"'spike'"});
  expect_all_in(refused({closed("spike", {{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 9}, {2, 3}, {0, 4}})}),
                {"'spike'"});
}

TEST(Validate, RefusesTheSameLoopTwice) {
  expect_all_in(refused({square("one", {0, 0}, 1), square("one", {0, 0}, 1)}), {"'one'"});
}

TEST(Validate, AcceptsCollinearPoints) {
  const auto places = validate(
      join_chains({closed("box", {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}})}));
  ASSERT_EQ(places.size(), 1u);
  EXPECT_TRUE(places[0].counter_clockwise);
  EXPECT_EQ(places[0].depth, 0);
}

TEST(Validate, TellsASegmentOneBitAwayFromATouch) {
  const double just_right = std::nextafter(1.0, 2.0);
  const auto far = closed("two", {{just_right, 0}, {2, -1}, {2, 1}});
  EXPECT_NO_THROW(validate(join_chains({square("one", {0, 0}, 1), far})));
}

TEST(Validate, ReportsTheFirstPairOfTheInput) {
  const auto far_right = square("right", {100, 0}, 1), right_twin = square("right_twin", {101, 0}, 1);
  const auto left = square("left", {0, 0}, 1), left_twin = square("left_twin", {1, 0}, 1);
  expect_all_in(refused({far_right, right_twin, left, left_twin}), {"'right'", "'right_twin'"});
  expect_all_in(refused({left, left_twin, far_right, right_twin}), {"'left'", "'left_twin'"});
}

/// A star with the given number of points: simple, and with steep and flat segments.
Chain star(const std::string& name, Point centre, double radius, int points) {
  Chain chain = closed(name, {});
  for (int i = 0; i < points; ++i) {
    const double angle = 2 * std::numbers::pi * i / points, r = radius * (i % 2 == 0 ? 1 : 0.8);
    chain.points.push_back({centre.x + r * std::cos(angle), centre.y + r * std::sin(angle)});
  }
  return chain;
}

TEST(Validate, AgreesWithTryingAllPairs) {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> coordinate(0, 12);
  int valid = 0;
  for (int trial = 0; trial < 4000; ++trial) {
    std::vector<Chain> chains;
    for (int loop = 0; loop < 2; ++loop) {
      std::vector<Point> points;
      const int size = 3 + trial % 3;
      for (int i = 0; i < size; ++i) points.push_back({1.0 * coordinate(random), 1.0 * coordinate(random)});
      chains.push_back(closed(loop == 0 ? "one" : "two", points));
    }
    std::vector<std::string> warnings;
    Outline outline;
    try {
      clean_chains(chains, warnings);
      outline = join_chains(chains);
    } catch (const InputError&) {
      continue;  // fewer than three points
    }
    const FlatOutline flat(outline);
    bool simple = true;
    const auto size = size32(flat.points);
    for (std::int32_t s = 0; s < size; ++s) {
      for (std::int32_t t = s + 1; t < size; ++t) simple = simple && !flat.faulty(s, t);
    }
    valid += simple;
    if (simple) {
      EXPECT_NO_THROW(validate(outline)) << trial;
    } else {
      EXPECT_THROW(validate(outline), InputError) << trial;
    }
  }
  EXPECT_GT(valid, 100);
}

/// Long chains go on from segment to segment along the sweep line, and turn back where the outline does.
TEST(Validate, AgreesWithTryingAllPairsOfLongLoops) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> share(0, 1);
  int valid = 0, refused_ones = 0;
  for (int trial = 0; trial < 600; ++trial) {
    const int size = 20 + trial % 60;
    std::vector<Point> points;
    for (int i = 0; i < size; ++i) {
      const double angle = 2 * std::numbers::pi * (i + (trial % 2 == 0 ? 2.5 : 0.9) * share(random)) / size;
      const double radius = std::round(64 * (0.3 + share(random)));  // on a lattice some points coincide
      points.push_back({std::round(radius * std::cos(angle)), std::round(radius * std::sin(angle))});
    }
    std::vector<Chain> chains{closed("one", points)};
    std::vector<std::string> warnings;
    clean_chains(chains, warnings);
    const Outline outline = join_chains(chains);
    const FlatOutline flat(outline);
    bool simple = true;
    for (std::int32_t s = 0; s < size32(flat.points); ++s) {
      for (std::int32_t t = s + 1; t < size32(flat.points); ++t) simple = simple && !flat.faulty(s, t);
    }
    (simple ? valid : refused_ones) += 1;
    if (simple) {
      EXPECT_NO_THROW(validate(outline)) << trial;
    } else {
      EXPECT_THROW(validate(outline), InputError) << trial;
    }
  }
  EXPECT_GT(valid, 100);
  EXPECT_GT(refused_ones, 100);
}

TEST(Validate, FindsTheDepthOfEveryLoop) {
  std::vector<Chain> chains;
  for (int ring = 0; ring < 40; ++ring) chains.push_back(star("ring", {0, 0}, std::pow(1.5, ring), 64));
  for (int i = 0; i < 20; ++i) chains.push_back(reversed(square("aside", {-1e9, 10.0 * i}, 1)));
  const auto places = validate(join_chains(chains));
  for (std::size_t ring = 0; ring < 40; ++ring) EXPECT_EQ(places[ring].depth, 39 - static_cast<int>(ring));
  for (std::size_t i = 40; i < 60; ++i) {
    EXPECT_EQ(places[i].depth, 0);
    EXPECT_FALSE(places[i].counter_clockwise);
  }
}

TEST(Validate, IsFastForLongParallelSegments) {
  std::vector<Chain> chains;
  constexpr int count = 20000;
  for (int i = 0; i < count; ++i) {  // thin slanted slivers, each one's box overlapping all others'
    const double y = i;
    chains.push_back(closed("sliver", {{0, y}, {1e6, y + 1e6}, {1e6, y + 1e6 + 0.5}}));
  }
  const auto start = std::chrono::steady_clock::now();
  validate(join_chains(chains));
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 20)
      << "quadratic?";
}

}  // namespace
}  // namespace quadloop
