// Blocks from closed lines, named boundaries and points; names of interfaces; refusals.
#include "mesher/geometry/assemble/block_loops.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/assemble.hpp"

namespace quadloop {
namespace {

Chain box_chain(const std::string& name, double low, double high) {
  return {name, false, {{low, low}, {high, low}, {high, high}, {low, high}}, {}};
}

/// A box of 10 around one of 2 around one of 1.
std::vector<Chain> nested() {
  return {box_chain("wall", -5, 5), box_chain("ring", -1, 1), box_chain("core", -0.5, 0.5)};
}

double area_of(const BlockOutline& blocks, const std::string& name) {
  double twice = 0;
  for (std::size_t l = 0; l < blocks.outline.loops.size(); ++l) {
    if (blocks.names[blocks.block_of_loop[l]] != name) continue;
    const std::vector<Point>& points = blocks.outline.loops[l].points;
    for (std::size_t i = 0; i < points.size(); ++i)
      twice += cross(points[i], points[(i + 1) % points.size()]);
  }
  return twice / 2;
}

std::set<std::string> names_of(const BlockOutline& blocks) {
  return {blocks.outline.names.begin(), blocks.outline.names.end()};
}

BlockOutline found(const std::vector<Chain>& chains, const std::vector<BlockRule>& rules) {
  Warnings warnings;
  return block_loops(chains, rules, 1e-9, warnings);
}

void expect_refusal(const std::vector<Chain>& chains, const std::vector<BlockRule>& rules,
                    const std::string& part) {
  try {
    found(chains, rules);
    ADD_FAILURE() << "no refusal: " << part;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("case:7"), std::string::npos) << error.what();
  }
}

const std::string where = "case:7";
BlockRule inside(const std::string& name, Point p) { return {name, {}, {}, p, where}; }
BlockRule within(const std::string& name, const std::string& loop) { return {name, {}, loop, {}, where}; }
BlockRule between(const std::string& name, std::vector<std::string> boundaries) {
  return {name, std::move(boundaries), {}, {}, where};
}

TEST(BlockLoops, LaterBlocksTakePrecedence) {
  const BlockOutline blocks = found(nested(), {within("fluid", "wall"), within("solid", "ring")});
  EXPECT_DOUBLE_EQ(area_of(blocks, "fluid"), 96);
  EXPECT_DOUBLE_EQ(area_of(blocks, "solid"), 4);
  EXPECT_EQ(names_of(blocks), (std::set<std::string>{"wall", "ring"}));
  const BlockOutline other = found(nested(), {within("solid", "ring"), within("fluid", "core")});
  EXPECT_DOUBLE_EQ(area_of(other, "solid"), 3);
  EXPECT_DOUBLE_EQ(area_of(other, "fluid"), 1);
}

TEST(BlockLoops, WhatALaterBlockCoversIsNoWarning) {
  std::vector<Chain> chains = nested();
  chains.push_back({"bar", false, {{-3, -0.2}, {3, -0.2}, {3, 0.2}, {-3, 0.2}}, {}});
  Warnings warnings;
  block_loops(chains, {within("fluid", "wall"), within("solid", "ring"), within("rod", "bar")}, 1e-9,
              warnings);
  ASSERT_EQ(warnings.size(), 1U) << "of the core, which encloses no block";
  EXPECT_EQ(warnings[0].find("boundary 'core': 8 segments"), 0U) << warnings[0];
}

TEST(BlockLoops, FacesOfNoBlockAreHoles) {
  const BlockOutline blocks = found(nested(), {inside("fluid", {2, 2}), inside("solid", {0.75, 0})});
  EXPECT_DOUBLE_EQ(area_of(blocks, "fluid"), 96);
  EXPECT_DOUBLE_EQ(area_of(blocks, "solid"), 3);
  EXPECT_EQ(blocks.outline.loops.size(), 4U);
}

TEST(BlockLoops, BoundariesEncloseABlockWhateverTheirDirection) {
  for (const bool turned : {false, true}) {
    std::vector<Chain> chains = nested();
    if (turned) std::ranges::reverse(chains[1].points);
    const BlockOutline blocks =
        found(chains, {between("plate", {"wall", "ring"}), between("hole", {"ring"})});
    EXPECT_DOUBLE_EQ(area_of(blocks, "plate"), 96);
    EXPECT_DOUBLE_EQ(area_of(blocks, "hole"), 4);
  }
}

TEST(BlockLoops, OneLineInBothDirectionsIsOneInterface) {
  std::vector<Chain> chains{box_chain("wall", -5, 5), box_chain("ring", -1, 1), box_chain("gas", -1, 1)};
  std::ranges::reverse(chains[2].points);
  chains[2].points[0].x += 1e-15;  // the same place in another file
  const BlockOutline blocks = found(chains, {between("plate", {"wall", "ring"}), between("hole", {"gas"})});
  EXPECT_DOUBLE_EQ(area_of(blocks, "plate"), 96);
  EXPECT_EQ(names_of(blocks), (std::set<std::string>{"wall", "ring"}));
  const Geometry g = [&] {
    AssembleOptions options;
    options.blocks = {between("plate", {"wall", "ring"}), between("hole", {"gas"})};
    Warnings warnings;
    Geometry made = assemble(chains, options, warnings);
    EXPECT_TRUE(warnings.empty()) << warnings.front();
    return made;
  }();
  std::map<bool, int> seconds;
  for (std::int32_t s = 0; s < g.size(); ++s) {
    if (g.boundary(g.boundary_of(s)).name != "ring") {
      EXPECT_LT(g.twin(s), 0);
      continue;
    }
    ASSERT_GE(g.twin(s), 0);
    EXPECT_EQ(g.twin(g.twin(s)), s);
    EXPECT_EQ(g.point(s), g.point(g.next(g.twin(s))));
    ++seconds[g.is_second(s)];
  }
  EXPECT_EQ(seconds[false], 4);
  EXPECT_EQ(seconds[true], 4);
}

TEST(BlockLoops, InterfacesOfSeveralPairsAreNamedByTheirBlocks) {
  std::vector<Chain> chains{box_chain("wall", 0, 4)};
  chains.push_back({"line", true, {{0, 1}, {4, 1}}, {}});
  chains.push_back({"line", true, {{0, 2}, {4, 2}}, {}});
  const BlockOutline blocks =
      found(chains, {inside("a", {1, 0.5}), inside("b", {1, 1.5}), inside("c", {1, 3})});
  EXPECT_EQ(names_of(blocks), (std::set<std::string>{"wall", "a__b", "b__c"}));
}

TEST(BlockLoops, CrossingsBecomePointsAndWhatBoundsNothingIsLeftOut) {
  std::vector<Chain> chains{box_chain("wall", 0, 4)};
  chains.push_back({"up", true, {{2, 0}, {2, 4}}, {}});
  chains.push_back({"across", true, {{0, 1}, {4, 3}}, {}});
  chains.push_back({"stray", true, {{0.5, 0.25}, {1, 0.5}}, {}});
  Warnings warnings;
  const BlockOutline blocks = block_loops(
      chains, {inside("a", {1, 0.1}), inside("b", {3, 0.1}), inside("c", {1, 3.9})}, 1e-9, warnings);
  EXPECT_DOUBLE_EQ(area_of(blocks, "a"), 3);
  EXPECT_DOUBLE_EQ(area_of(blocks, "b"), 5);
  EXPECT_DOUBLE_EQ(area_of(blocks, "c"), 5);
  ASSERT_EQ(warnings.size(), 2U) << "the wall round the fourth region, and the stray line";
  EXPECT_NE(warnings[0].find("'stray'"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[0].find("(0.5, 0.25)"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[1].find("'wall'"), std::string::npos) << warnings[1];
}

TEST(BlockLoops, RunAlongInnerLinesAndBack) {
  std::vector<Chain> chains{box_chain("wall", 0, 4)};
  const auto add = [&](const std::string& name, std::vector<Point> points) {
    chains.push_back({name, true, std::move(points), {}});
    chains.back().inner_line = true;
  };
  add("from_wall", {{2, 0}, {2, 3}});
  add("crossing", {{3, 1}, {1, 1}, {1, 3}});
  add("apart", {{3, 2}, {3, 3}});
  add("partly", {{3.5, 3}, {3.5, 5}});
  add("along", {{0, 2}, {0, 3}, {0.5, 3}});
  Warnings warnings;
  const BlockOutline blocks = block_loops(chains, {within("all", "wall")}, 1e-9, warnings);
  ASSERT_EQ(blocks.outline.loops.size(), 2U) << "all that hangs together, and the line apart";
  EXPECT_DOUBLE_EQ(area_of(blocks, "all"), 16);
  std::map<std::string, std::pair<int, int>> there_and_back;
  for (const OutlineLoop& loop : blocks.outline.loops) {
    for (std::size_t i = 0; i < loop.points.size(); ++i) {
      auto& [there, back] = there_and_back[blocks.outline.names[loop.boundary[i].value()]];
      ++(loop.returns[i] != 0 ? back : there);
    }
  }
  const std::pair one(1, 1), three(3, 3);
  EXPECT_EQ(there_and_back["from_wall"], std::pair(2, 2)) << "divided at the crossing";
  EXPECT_EQ(there_and_back["crossing"], three);
  EXPECT_EQ(there_and_back["apart"], one);
  EXPECT_EQ(there_and_back["partly"], one);
  EXPECT_EQ(there_and_back["along"], one);
  EXPECT_EQ(there_and_back["wall"].second, 0);
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_NE(warnings[0].find("'partly': 1 segment"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[1].find("'along': 1 segment of the inner line"), std::string::npos) << warnings[1];
}

TEST(BlockLoops, BlocksReachAcrossInnerLines) {
  std::vector<Chain> chains{box_chain("wall", -5, 5), box_chain("ring", -1, 1),
                            box_chain("gauge", -0.5, 0.5)};
  chains.push_back({"cut", true, {{-0.5, 3}, {-0.5, -3}}, {}});
  for (std::size_t c = 2; c < chains.size(); ++c) chains[c].inner_line = true;
  for (const Point p : {Point{0, 0}, Point{0.75, 0}, Point{-0.75, 0}, Point{0.5, 0}, Point{-0.5, 0.25}}) {
    const BlockOutline blocks = found(chains, {within("fluid", "wall"), inside("solid", p)});
    EXPECT_DOUBLE_EQ(area_of(blocks, "solid"), 4) << p.x;
    EXPECT_DOUBLE_EQ(area_of(blocks, "fluid"), 96) << p.x;
    EXPECT_EQ(names_of(blocks), (std::set<std::string>{"wall", "ring", "gauge", "cut"})) << p.x;
  }
  expect_refusal(chains, {within("solid", "gauge")}, "'gauge' is an inner line, which bounds no block");
  expect_refusal(chains, {between("solid", {"ring", "cut"})}, "'cut' is an inner line");
}

TEST(BlockLoops, RefusesWithThePlace) {
  expect_refusal(nested(), {inside("fluid", {9, 9})}, "(9, 9)");
  expect_refusal(nested(), {inside("fluid", {5, 2})}, "lies on boundary 'wall'");
  expect_refusal(nested(), {inside("fluid", {5, 2 + 1e-16})}, "lies on boundary 'wall'");
  expect_refusal(nested(), {inside("fluid", {5 - 1e-12, 2})}, "lies on boundary 'wall'");
  expect_refusal(nested(), {within("solid", "rings")}, "no boundary 'rings'");
  expect_refusal(nested(), {within("solid", "ring"), inside("fluid", {0.75, 0}), inside("fluid", {0, 0})},
                 "block 'solid' has no region of its own");
  std::vector<Chain> open{box_chain("wall", 0, 4)};
  open.push_back({"line", true, {{0, 1}, {4, 1}}, {}});
  expect_refusal(open, {between("low", {"line"})}, "one ends at (4, 1)");
}

}  // namespace
}  // namespace quadloop
