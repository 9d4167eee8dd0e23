// The wanted tree's parts, each alone: what the rules say of one quadrant, and that no answer depends on what
// was asked before.
#include "mesher/sizes/size_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

#include "mesher/sizes/leaves_ahead.hpp"
#include "mesher/sizes/size_cursor.hpp"
#include "mesher/sizes/size_rules.hpp"
#include "tests/sizes/diamond_sizes.hpp"

namespace quadloop {
namespace {

/// Of a small diamond, whose sides ask for leaves of 0.02, in the square's upper right quarter.
struct Sizes : test::DiamondSizes {
  explicit Sizes(const std::vector<SizeSource>& sources = {})
      : DiamondSizes({{0.6, 0.6}, 0.07}, 0.02, 0.01, 0.3) {
    options.sources = sources;
  }
};

Quadrant quadrant(int level, std::int64_t column, std::int64_t row) {
  const int shift = Quadrant::unit_level - level;
  return {column << shift, row << shift, level};
}

std::vector<Quadrant> all_of_level(int level) {
  std::vector<Quadrant> all;
  for (std::int64_t row = 0; row < std::int64_t{1} << level; ++row) {
    for (std::int64_t column = 0; column < std::int64_t{1} << level; ++column)
      all.push_back(quadrant(level, column, row));
  }
  return all;
}

TEST(SizeRules, EmptyQuadrantsOfTheDomainAreSplitDownToMax) {
  const Sizes sizes;
  const SizeTree tree = sizes.tree();
  const SizeRules& rules = tree.rules();
  EXPECT_EQ(rules.coarsest_level(), 4);  // 3 / 16 <= 0.3
  EXPECT_EQ(rules.finest_level(), 8);    // 3 / 256 >= 0.01
  EXPECT_TRUE(rules.wants_split(sizes.at(quadrant(3, 2, 2))));
  EXPECT_FALSE(rules.wants_split(sizes.at(quadrant(4, 4, 4))));
  EXPECT_FALSE(rules.wants_split(sizes.at(quadrant(3, 0, 0)))) << "it lies outside the domain";
  EXPECT_EQ(rules.gap_to_domain(quadrant(4, 0, 4)), rules.gap_to_domain(quadrant(4, 4, 0)));
  EXPECT_GT(rules.gap_to_domain(quadrant(4, 0, 4)), 0);
  EXPECT_EQ(rules.gap_to_domain(quadrant(4, 4, 4)), 0);
}

TEST(SizeRules, SegmentsAskForTheirSpacingDownToMin) {
  const Sizes sizes;
  const SizeTree tree = sizes.tree();
  const std::vector<std::int32_t> frame{0}, diamond{0, 5};
  const Quadrant q = quadrant(5, 9, 9);
  EXPECT_FALSE(tree.rules().wants_split(sizes.at(q, frame)));
  EXPECT_TRUE(tree.rules().wants_split(sizes.at(q, diamond)));
  EXPECT_FALSE(tree.rules().wants_split(sizes.at(quadrant(8, 9, 9), diamond)));
  EXPECT_EQ(tree.rules().level_of_outline(q, diamond), 8);
  EXPECT_EQ(tree.rules().level_of_outline(q, frame), 4);
}

TEST(SizeRules, ADemandIsGranted) {
  const Sizes sizes;
  const SizeTree tree = sizes.tree();
  SizedQuadrant q = sizes.at(quadrant(8, 9, 9));
  q.finest_demanded = 10;
  EXPECT_TRUE(tree.rules().wants_split(q));
}

TEST(SizeRules, PlainIsWhereNothingAsksForMore) {
  const Sizes sizes({{Box{{-0.9, -0.9}, {-0.8, -0.8}}, 0.05}});
  const SizeTree tree = sizes.tree();
  const auto judged = [&](const SizedQuadrant& q) { return tree.rules().judge(q); };
  const std::vector<std::int32_t> segment{5};
  EXPECT_TRUE(judged(sizes.at(quadrant(4, 9, 9))).plain);
  EXPECT_EQ(judged(sizes.at(quadrant(4, 9, 9))).finest, 4);
  EXPECT_FALSE(judged(sizes.at(quadrant(4, 9, 9), segment)).plain);
  EXPECT_EQ(judged(sizes.at(quadrant(4, 9, 9), segment)).finest, 8);
  EXPECT_FALSE(judged(sizes.at(quadrant(3, 1, 1))).plain) << "the source touches it";
  EXPECT_EQ(judged(sizes.at(quadrant(3, 1, 1))).finest, 6);
  SizedQuadrant made = sizes.at(quadrant(7, 90, 90));
  made.made_by_demand = true;
  EXPECT_FALSE(judged(made).plain);
  EXPECT_EQ(judged(made).finest, 7);
  SizedQuadrant demanded = sizes.at(quadrant(4, 9, 9));
  demanded.finest_demanded = 6;
  EXPECT_FALSE(judged(demanded).plain);
  EXPECT_EQ(judged(demanded).finest, 6);
}

TEST(SizeTree, NodesHoldWhatMeetsThem) {
  const Sizes sizes;
  const SizeTree tree = sizes.tree();
  for (std::int32_t n = 0; n < tree.size(); ++n) {  // it grows meanwhile
    tree.is_split(n);
    const SizeTree::Node node = tree.node(n);
    const auto found = tree.segments_of(node);
    std::vector<std::int32_t> wanted;
    for (std::int32_t s = 0; s < sizes.geometry.size(); ++s) {
      if (sizes.outline.meets(s, sizes.lattice.box_of(node.quadrant))) wanted.push_back(s);
    }
    EXPECT_EQ(std::vector<std::int32_t>(found.begin(), found.end()), wanted);
    if (node.parent >= 0) {
      EXPECT_TRUE(tree.node(node.parent).quadrant.contains(node.quadrant));
    }
    EXPECT_LE(node.deepest_split, node.finest);
  }
  EXPECT_GT(tree.size(), 300);
}

TEST(SizeTree, AnswersDoNotDependOnTheOrderOfQuestions) {
  const Sizes sizes({{Box{{-0.9, -0.9}, {-0.8, -0.8}}, 0.05}});
  std::vector<Quadrant> questions;
  for (int level = 1; level <= 7; ++level) {
    const std::vector<Quadrant> all = all_of_level(level);
    questions.insert(questions.end(), all.begin(), all.end());
  }
  std::shuffle(questions.begin(), questions.end(), std::mt19937_64(2));
  questions.resize(2000);
  const SizeTree shared = sizes.tree();
  SizeCursor cursor(shared);
  Gradation gradation(shared);
  LeavesAhead ahead(shared, gradation);
  int split = 0, holding = 0;
  for (const Quadrant& q : questions) {
    const SizeTree own = sizes.tree();
    SizeCursor own_cursor(own);
    Gradation own_gradation(own);
    EXPECT_EQ(gradation.must_split(q), own_gradation.must_split(q));
    EXPECT_EQ(cursor.wanted_level(q), own_cursor.wanted_level(q));
    const auto found = cursor.segments_in(q), alone = own_cursor.segments_in(q);
    EXPECT_TRUE(std::ranges::equal(found, alone));
    for (std::int32_t s = 0; s < sizes.geometry.size(); ++s)
      EXPECT_EQ(std::ranges::count(found, s), sizes.outline.meets(s, sizes.lattice.box_of(q)) ? 1 : 0);
    EXPECT_EQ(ahead.below(q), LeavesAhead(own, own_gradation).below(q));
    split += gradation.must_split(q) ? 1 : 0;
    holding += found.empty() ? 0 : 1;
  }
  EXPECT_GT(split, 20);
  EXPECT_GT(holding, 20);
}

TEST(LeavesAhead, IsMostWhereMostLeavesAre) {
  const Sizes sizes;
  const SizeTree tree = sizes.tree();
  Gradation gradation(tree);
  LeavesAhead ahead(tree, gradation);
  const auto count = [&](const auto& self, const Quadrant& q) -> double {
    if (!gradation.must_split(q)) return 1;
    double leaves = 0;
    for (const Corner quarter : corners_along_curve) leaves += self(self, q.child(quarter));
    return leaves;
  };
  double truth = 0, guess = 0, most = 0, most_guessed = 0, guess_of_most = 0;
  for (const Quadrant& q : all_of_level(2)) {
    if (!gradation.must_split(q)) continue;
    const double leaves = count(count, q), guessed = ahead.below(q);
    EXPECT_GE(guessed, 1);
    truth += leaves;
    guess += guessed;
    most_guessed = std::max(most_guessed, guessed);
    if (leaves > most) std::tie(most, guess_of_most) = std::pair(leaves, guessed);
  }
  EXPECT_GE(guess_of_most, most_guessed / 2) << "most leaves are looked for where most are";
  EXPECT_GE(guess, truth / 5);
  EXPECT_LE(guess, truth * 5);
}

}  // namespace
}  // namespace quadloop
