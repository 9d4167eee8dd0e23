#include "mesher/geometry/validate.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "mesher/base/error.hpp"
#include "mesher/base/ids.hpp"
#include "mesher/geometry/assemble/join_chains.hpp"
#include "mesher/geometry/meeting_pairs.hpp"
#include "mesher/geometry/predicates.hpp"
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

TEST(Validate, LetsLoopsTouchAtAVertexOfBoth) {
  const auto beside = validate(join_chains({square("one", {0, 0}, 1), square("two", {2, 2}, 1)}));
  EXPECT_EQ(beside[0].depth, 0);
  EXPECT_EQ(beside[1].depth, 0);
  // Holes that touch each other and the outer boundary, at its leftmost point and at another.
  for (const bool turned : {false, true}) {
    Chain outer = closed("outer", {{0, 0}, {9, -4}, {9, 4}});
    const Chain left = closed("left", {{0, 0}, {4, 1}, {4, -1}}),
                right = closed("right", {{4, 1}, {9, 4}, {6, 0}});
    if (turned) outer = reversed(outer);
    for (const auto& chains : {std::vector{outer, left, right}, std::vector{right, left, outer}}) {
      const auto places = validate(join_chains(chains));
      const std::size_t at = chains[0].name == "outer" ? 0 : 2;
      EXPECT_EQ(places[at].depth, 0);
      EXPECT_EQ(places[at].counter_clockwise, !turned);
      EXPECT_EQ(places[2 - at].depth, 1);
      EXPECT_EQ(places[1].depth, 1);
      EXPECT_EQ(places[1].parent, static_cast<std::int32_t>(at));
      EXPECT_FALSE(places[1].counter_clockwise);
    }
  }
}

TEST(Validate, RefusesLoopsThatCrossInAVertexOfBoth) {
  const Chain one = closed("one", {{0, 0}, {4, 0}, {2, 2}, {4, 4}, {0, 4}});
  expect_all_in(refused({one, closed("two", {{2, 2}, {1, 1}, {6, 2}})}), {"'one'", "'two'", "(2, 2)"});
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

/// By angles: whether loops cross in a point of both.
bool cross_at_a_vertex(const FlatOutline& flat) {
  const auto size = size32(flat.points);
  const auto angle = [&](std::int32_t v, std::int32_t to) {
    const Point d = flat.point(to) - flat.point(v);
    return std::atan2(d.y, d.x);
  };
  for (std::int32_t v = 0; v < size; ++v) {
    const auto [low, high] = std::minmax({angle(v, flat.previous(v)), angle(v, flat.next(v))});
    for (std::int32_t w = 0; w < size; ++w) {
      if (v == w || flat.point(v) != flat.point(w)) continue;
      const auto between = [&, low = low, high = high](std::int32_t to) {
        return angle(w, to) > low && angle(w, to) < high;
      };
      if (between(flat.previous(w)) != between(flat.next(w))) return true;
    }
  }
  return false;
}

/// How many other loops are round the middle of a loop's first segment, on which no other loop lies.
std::int32_t depth_of(const FlatOutline& flat, std::size_t loop) {
  const std::int32_t first = flat.loop_starts[loop];
  const Point p = 0.5 * (flat.point(first) + flat.point(flat.next(first)));
  std::set<std::size_t> odd;
  for (std::int32_t s = 0; s < size32(flat.points); ++s) {
    const Point a = flat.point(s), b = flat.point(flat.next(s));
    if (flat.loop(s) == loop || (a.y > p.y) == (b.y > p.y)) continue;
    if ((orientation(a, b, p) > 0) != (b.y > a.y)) continue;
    if (!odd.insert(flat.loop(s)).second) odd.erase(flat.loop(s));
  }
  return static_cast<std::int32_t>(odd.size());
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
  int valid = 0, touching = 0, nested = 0;
  for (int trial = 0; trial < 16000; ++trial) {
    std::vector<Chain> chains;
    for (int loop = 0; loop < 2 + trial % 2; ++loop) {
      std::vector<Point> points;
      const int size = 3 + trial % 3;
      const Point corner{1.0 * (coordinate(random) % 8), 1.0 * (coordinate(random) % 8)};
      const int within = trial % 2 == 0 || loop == 0 ? 13 : 5;  // small loops often lie in others
      for (int i = 0; i < size; ++i) {
        const Point p{1.0 * (coordinate(random) % within), 1.0 * (coordinate(random) % within)};
        points.push_back(within == 13 ? p : corner + p);
      }
      if (trial % 4 == 1 && loop == 0) points = {{0, 0}, {12, 0}, {12, 12}, {0, 12}};
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
    simple = simple && !cross_at_a_vertex(flat);
    valid += simple;
    if (simple) {
      touching += std::set<Point>(flat.points.begin(), flat.points.end()).size() < flat.points.size();
      const auto places = validate(outline);
      for (std::size_t l = 0; l < places.size(); ++l) {
        EXPECT_EQ(places[l].depth, depth_of(flat, l)) << trial;
        nested += places[l].depth > 0;
      }
    } else {
      EXPECT_THROW(validate(outline), InputError) << trial;
    }
  }
  EXPECT_GT(valid, 100);
  EXPECT_GT(touching, 100);
  EXPECT_GT(nested, 100);
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
      const double radius = std::round(64 * (0.3 + share(random)));  // on a grid some points coincide
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
