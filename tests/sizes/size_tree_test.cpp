// The wanted tree's parts, each alone: what the rules say of one quadrant, and that no answer depends on what
// was asked before.
#include "mesher/sizes/size_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "mesher/sizes/leaves_ahead.hpp"
#include "mesher/sizes/size_cursor.hpp"
#include "mesher/sizes/size_rules.hpp"
#include "tests/sizes/diamond_sizes.hpp"

namespace quadloop {
namespace {

/// Of a small diamond, whose sides ask for leaves of 0.02, in the square's upper right quarter.
struct SmallDiamondSizes : test::DiamondSizes {
  explicit SmallDiamondSizes(const std::vector<SizeSource>& sources = {})
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
  const SmallDiamondSizes sizes;
  SizeTree tree = sizes.tree();
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
  const SmallDiamondSizes sizes;
  SizeTree tree = sizes.tree();
  const std::vector<std::int32_t> frame{0}, diamond{0, 5};
  const Quadrant q = quadrant(5, 9, 9);
  EXPECT_FALSE(tree.rules().wants_split(sizes.at(q, frame)));
  EXPECT_TRUE(tree.rules().wants_split(sizes.at(q, diamond)));
  EXPECT_FALSE(tree.rules().wants_split(sizes.at(quadrant(8, 9, 9), diamond)));
  EXPECT_EQ(tree.rules().level_of_outline(q, diamond), 8);
  EXPECT_EQ(tree.rules().level_of_outline(q, frame), 4);
}

TEST(SizeRules, ADemandIsGranted) {
  const SmallDiamondSizes sizes;
  SizeTree tree = sizes.tree();
  SizedQuadrant q = sizes.at(quadrant(8, 9, 9));
  q.finest_demanded = 10;
  EXPECT_TRUE(tree.rules().wants_split(q));
}

TEST(SizeRules, PlainIsWhereNothingAsksForMore) {
  const SmallDiamondSizes sizes({{Box{{-0.9, -0.9}, {-0.8, -0.8}}, 0.05}});
  SizeTree tree = sizes.tree();
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
  const SmallDiamondSizes sizes;
  SizeTree tree = sizes.tree();
  for (std::int32_t n = 0; n < tree.size(); ++n) {  // it grows meanwhile
    tree.is_split(n);
    const SizeTree::Node node = tree.node(n);
    const auto found = tree.segments_of(node);
    std::vector<std::int32_t> wanted;
    for (std::int32_t s = 0; s < sizes.geometry.size(); ++s) {
      if (sizes.outline.meets(s, sizes.grid.box_of(node.quadrant))) wanted.push_back(s);
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
  const SmallDiamondSizes sizes({{Box{{-0.9, -0.9}, {-0.8, -0.8}}, 0.05}});
  std::vector<Quadrant> questions;
  for (int level = 1; level <= 7; ++level) {
    const std::vector<Quadrant> all = all_of_level(level);
    questions.insert(questions.end(), all.begin(), all.end());
  }
  std::shuffle(questions.begin(), questions.end(), std::mt19937_64(2));
  questions.resize(2000);
  SizeTree shared = sizes.tree();
  SizeCursor cursor(shared);
  Gradation gradation(shared);
  LeavesAhead ahead(shared, gradation);
  int split = 0, holding = 0;
  for (const Quadrant& q : questions) {
    SizeTree own = sizes.tree();
    SizeCursor own_cursor(own);
    Gradation own_gradation(own);
    EXPECT_EQ(gradation.must_split(q), own_gradation.must_split(q));
    EXPECT_EQ(cursor.target_level(q), own_cursor.target_level(q));
    const auto found = cursor.segments_in(q), alone = own_cursor.segments_in(q);
    EXPECT_TRUE(std::ranges::equal(found, alone));
    for (std::int32_t s = 0; s < sizes.geometry.size(); ++s)
      EXPECT_EQ(std::ranges::count(found, s), sizes.outline.meets(s, sizes.grid.box_of(q)) ? 1 : 0);
    EXPECT_EQ(ahead.below(q), LeavesAhead(own, own_gradation).below(q));
    split += gradation.must_split(q) ? 1 : 0;
    holding += found.empty() ? 0 : 1;
  }
  EXPECT_GT(split, 20);
  EXPECT_GT(holding, 20);
}

TEST(SizeTree, OfASymmetricOutlineIsSymmetric) {
  constexpr double sharp = 180;  // no corner is kept, so that each asks for small leaves by its turn
  test::DiamondSizes sizes({{0.6, 0}, 0.37}, 1, 0.01, 0.5, sharp);
  sizes.options.curvature = 80;
  SizeTree tree = sizes.tree();
  SizeCursor cursor(tree);
  int finest = 0;
  for (const Quadrant& q : all_of_level(tree.rules().finest_level())) {
    const Quadrant image{q.x, (std::int64_t{1} << Quadrant::unit_level) - q.y - q.size(), q.level};
    EXPECT_EQ(cursor.target_level(q), cursor.target_level(image)) << q.x << ' ' << q.y;
    if (cursor.target_level(q) == q.level) ++finest;
  }
  EXPECT_EQ(finest, 24) << "four at each corner, and on both sides of those on the middle line";
}

TEST(SizeTree, GrowsAgainWhatItHasForgotten) {
  const SmallDiamondSizes sizes;
  SizeTree tree = sizes.tree();
  const auto answers = [&] {
    SizeCursor cursor(tree);
    std::vector<std::pair<int, std::size_t>> found;
    for (const Quadrant& q : all_of_level(7))
      found.emplace_back(cursor.target_level(q), cursor.segments_in(q).size());
    return found;
  };
  const auto before = answers();
  const std::int32_t grown = tree.size();
  tree.forget();
  EXPECT_EQ(tree.size(), 1);
  EXPECT_EQ(answers(), before);
  EXPECT_EQ(tree.size(), grown);
}

TEST(LeavesAhead, IsMostWhereMostLeavesAre) {
  const SmallDiamondSizes sizes;
  SizeTree tree = sizes.tree();
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

/// Round the middle of a square of edge 8, whose grid lines all its vertices lie on; a void, or the
/// domain.
Geometry star_on_grid(std::mt19937& random, bool is_void) {
  constexpr double middle = 4;
  std::uniform_int_distribution<int> place(-7, 7);
  const auto angle = [](Point p) { return std::atan2(p.y - middle, p.x - middle); };
  std::vector<Point> points{{2, 2}, {6, 2}, {6, 6}, {2, 6}};
  while (points.size() < 12) {
    const Point p{middle + 0.5 * place(random), middle + 0.5 * place(random)};
    const bool twice =
        std::ranges::any_of(points, [&](Point q) { return std::abs(angle(p) - angle(q)) < 1e-6; });
    if (!twice && p != Point{middle, middle}) points.push_back(p);
  }
  std::ranges::sort(points, {}, angle);
  if (is_void) std::ranges::reverse(points);
  points.insert(points.begin(), {{0, 0}, {8, 0}, {8, 8}, {0, 8}});
  std::vector<std::int32_t> loops{0, 4, size32(points)};
  if (!is_void) {
    points.erase(points.begin(), points.begin() + 4);
    loops = {0, size32(points)};
  }
  return {{{"wall", 0.3, 30, "wall"}}, points, loops, std::vector<BoundaryId>(points.size(), BoundaryId{0})};
}

/// Below a node, against what outline and interior say of each quadrant alone.
void expect_outline_at(SizeTree& tree, const Interior& inside, std::int32_t n) {
  const SizeTree::Node node = tree.node(n);
  const Box box = tree.grid().box_of(node.quadrant);
  std::vector<std::int32_t> expected;
  for (std::int32_t s = 0; s < tree.rules().outline().geometry().size(); ++s) {
    if (tree.rules().outline().meets(s, box)) expected.push_back(s);
  }
  const auto segments = tree.segments_of(node);
  EXPECT_EQ(std::vector<std::int32_t>(segments.begin(), segments.end()), expected);
  EXPECT_EQ(node.winding, inside.contains(box.low) ? 1 : 0);
  SizeCursor cursor(tree);
  for (const Corner corner : corners_along_curve) {
    for (const Quadrant& q : {node.quadrant, node.quadrant.child(corner)}) {
      const Point at = tree.grid().corner(q.at(site_of(corner)));
      EXPECT_EQ(cursor.is_inside(q, corner), inside.contains(at));
    }
  }
  if (!tree.is_split(n)) return;
  for (std::int32_t k = 0; k < 4; ++k) expect_outline_at(tree, inside, tree.node(n).children + k);
}

TEST(SizeTree, KnowsSegmentsAndSidesAlsoWhereVerticesLieOnTheLattice) {
  std::mt19937 random(7);
  for (int trial = 0; trial < 40; ++trial) {
    const Geometry geometry = star_on_grid(random, trial % 2 == 0);
    const ShiftedOutline outline(geometry);
    const Interior inside(outline);
    const DemandedSplits demanded;
    SizeOptions options;
    options.min = 0.2;
    options.max = 2;
    for (const int trees : {1, 4}) {
      const TreeGrid grid(Box{{0, 0}, {8, 8}}, trees, trees);
      SizeTree tree(
          outline, grid, options, [](const Quadrant&, std::span<const std::int32_t>) { return false; },
          demanded);
      ASSERT_EQ(tree.roots().size(), static_cast<std::size_t>(trees) * trees);
      for (const std::int32_t root : tree.roots()) expect_outline_at(tree, inside, root);
    }
  }
}

}  // namespace
}  // namespace quadloop
