#include "mesher/geometry/assemble/pair_outlines.hpp"

#include <gtest/gtest.h>

#include "mesher/base/error.hpp"

namespace quadloop {
namespace {

/// A square whose east side has the given points; in the order south, east, north, west.
Outline square(const std::vector<Point>& east) {
  Outline outline{{"south", "east", "north", "west"}, {{}}};
  OutlineLoop& loop = outline.loops[0];
  loop.points = {{0, 0}};
  loop.boundary = {BoundaryId{0}};
  for (std::size_t i = 0; i < east.size(); ++i) {
    loop.points.push_back(east[i]);
    loop.boundary.push_back(BoundaryId{i + 1 < east.size() ? 1 : 2});
  }
  loop.points.push_back({0, 2});
  loop.boundary.push_back(BoundaryId{3});
  return outline;
}

std::vector<WantedPair> west_to_east(Point way) { return {{{"west", "east", way}, "case.toml:3"}}; }

std::string said_of(Outline outline, const std::vector<WantedPair>& pairs) {
  std::vector<std::string> warnings;
  try {
    match_outlines(outline, pairs, warnings);
  } catch (const InputError& error) {
    return error.what();
  }
  return warnings.empty() ? "" : warnings.front();
}

TEST(PairOutlines, TheImageTakesThePlaceOfTheSecondSide) {
  Outline outline = square({{2, 0}, {2, 0.5}, {2.000003, 2}});
  std::vector<std::string> warnings;
  match_outlines(outline, west_to_east({2, 0}), warnings);
  std::vector<Point> points = outline.loops[0].points;
  std::ranges::sort(points);
  EXPECT_EQ(points, (std::vector<Point>{{0, 0}, {0, 2}, {2, 0}, {2, 2}}))
      << "the point between is no vertex of west";
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0],
            "boundary 'east' moved by up to 3e-06, near (2, 2), to be the image of 'west' exactly");
}

TEST(PairOutlines, WhatDoesNotMatchIsRefusedWithItsPlace) {
  EXPECT_EQ(said_of(square({{2, 0}, {2, 2}}), west_to_east({2, 0})), "");
  EXPECT_EQ(
      said_of(square({{2, 0}, {2, 2}}), west_to_east({1.5, 0})),
      "case.toml:3: [[pair]]: boundary 'east' is not the image of 'west' by translation = [1.5, 0]: they "
      "are 0.5 apart at (1.5, 0); correct the map, or the outline there");
  EXPECT_NE(
      said_of(square({{2, 0}, {2.25, 1}, {2, 2}}), west_to_east({2, 0})).find("0.25 apart at (2.25, 1)"),
      std::string::npos);
}

TEST(PairOutlines, ASideIsOneOpenLine) {
  Outline twice = square({{2, 0}, {2, 1}, {2, 2}});
  twice.loops[0].boundary[0] = BoundaryId{2};  // south belongs to north
  EXPECT_NE(said_of(twice, {{{"north", "west", {1, 0}}, "c"}}).find("begins again"), std::string::npos);
  Outline closed = square({{2, 0}, {2, 2}});
  closed.loops[0].boundary.assign(4, BoundaryId{3});
  closed.loops.push_back(square({{2, 0}, {2, 2}}).loops[0]);
  EXPECT_NE(said_of(closed, west_to_east({2, 0})).find("closed loop"), std::string::npos);
  EXPECT_NE(said_of(square({{2, 0}, {2, 2}}), {{{"west", "eats", {2, 0}}, "c"}}).find("'east'"),
            std::string::npos);
}

}  // namespace
}  // namespace quadloop
