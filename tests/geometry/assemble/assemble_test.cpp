#include "mesher/geometry/assemble/assemble.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "mesher/base/error.hpp"
#include "tests/geometry/outlines.hpp"

namespace quadloop {
namespace {

using test::closed;
using test::loop_area;
using test::open;
using test::refusal;
using test::reversed;
using test::square;

Geometry assembled(std::vector<Chain> chains, Warnings* told = nullptr) {
  Warnings warnings;
  Geometry geometry = assemble(std::move(chains), {}, warnings);
  if (told != nullptr) *told = warnings;
  return geometry;
}

std::string refused(std::vector<Chain> chains) {
  return refusal([&] { assembled(chains); });
}

TEST(Assemble, KeepsAGoodLoopAsItIs) {
  Warnings warnings;
  const Geometry g = assembled({square("box", {0, 0}, 1)}, &warnings);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(g.size(), 4);
  EXPECT_EQ(g.loop_count(), 1);
  EXPECT_EQ(g.point(0), (Point{-1, -1}));
  EXPECT_EQ(g.point(1), (Point{1, -1}));
}

TEST(Assemble, TurnsLoopsByNestingDepth) {
  Warnings warnings;
  const auto lake = square("lake", {0, 0}, 1), island = square("island", {0, 0}, 2),
             sea = square("sea", {0, 0}, 4);
  const Geometry g = assembled({reversed(lake), island, sea}, &warnings);
  EXPECT_GT(loop_area(g, 0), 0);
  EXPECT_LT(loop_area(g, 1), 0);
  EXPECT_GT(loop_area(g, 2), 0);
  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_NE(warnings[0].find("'lake'"), std::string::npos);
  EXPECT_NE(warnings[1].find("'island'"), std::string::npos);
  EXPECT_NE(warnings[2].find("2 regions that are not connected"), std::string::npos) << warnings[2];
}

TEST(Assemble, SaysWhatALonelyOutlineEncloses) {
  Warnings warnings;
  assembled({reversed(square("airfoil", {0, 0}, 1))}, &warnings);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("geometry.far_field"), std::string::npos);
}

TEST(Assemble, TurnsLoopsWithoutADirectionInSilence) {
  Warnings warnings;
  Chain drawn = reversed(square("rim", {0, 0}, 1));
  drawn.directed = false;
  EXPECT_GT(loop_area(assembled({drawn}, &warnings), 0), 0);
  EXPECT_TRUE(warnings.empty());
}

TEST(Assemble, SaysNothingOfADomainThatIsKnown) {
  Warnings warnings;
  AssembleOptions options;
  options.domain_is_known = true;
  const Geometry g =
      assemble({reversed(square("fore", {0, 0}, 1)), square("aft", {5, 0}, 1)}, options, warnings);
  EXPECT_EQ(g.loop_count(), 2);
  EXPECT_TRUE(warnings.empty());
}

TEST(Assemble, JoinsOpenChains) {
  const Geometry g =
      assembled({open("coast", {{0, 0}, {1, 0}, {1, 1}}), open("sea", {{1, 1}, {0, 1}, {0, 0}})});
  ASSERT_EQ(g.size(), 4);
  EXPECT_EQ(g.boundary(g.boundary_of(0)).name, "coast");
  EXPECT_EQ(g.boundary(g.boundary_of(1)).name, "coast");
  EXPECT_EQ(g.boundary(g.boundary_of(2)).name, "sea");
  EXPECT_TRUE(g.kept(0)) << "two boundaries meet here";
}

TEST(Assemble, JoinsChainsInAnyDirection) {
  const Geometry straight =
      assembled({open("a", {{0, 0}, {1, 0}, {1, 1}}), open("b", {{1, 1}, {0, 1}, {0, 0}})});
  const Geometry mixed =
      assembled({open("a", {{0, 0}, {1, 0}, {1, 1}}), open("b", {{0, 0}, {0, 1}, {1, 1}})});
  EXPECT_EQ(straight.digest(), mixed.digest());
}

TEST(Assemble, TurnsALoopOfChainsWithItsBoundaries) {
  Warnings warnings;
  const Geometry g =
      assembled({open("a", {{0, 0}, {0, 1}, {1, 1}}), open("b", {{1, 1}, {1, 0}, {0, 0}})}, &warnings);
  EXPECT_EQ(warnings.size(), 1u);
  EXPECT_GT(loop_area(g, 0), 0);
  for (std::int32_t s = 0; s < g.size(); ++s) {
    const bool on_a = g.point(s).x == 0 && g.point(g.next(s)).x == 0;
    EXPECT_TRUE(!on_a || g.boundary(g.boundary_of(s)).name == "a") << s;
  }
}

TEST(Assemble, MakesOneBoundaryOfOneName) {
  const Geometry g = assembled({square("sea", {0, 0}, 9), reversed(square("island", {-3, 0}, 1)),
                                reversed(square("island", {3, 0}, 1))});
  EXPECT_EQ(g.boundaries().size(), 2u);
  EXPECT_EQ(g.loop_count(), 3);
  EXPECT_EQ(g.boundary_of(4), g.boundary_of(8));
}

TEST(Assemble, DropsRepeatedPointsWithAWarning) {
  Warnings warnings;
  const Geometry g = assembled({closed("box", {{0, 0}, {1, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}})}, &warnings);
  EXPECT_EQ(g.size(), 4);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("2 points"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[0].find("(1, 0)"), std::string::npos) << warnings[0];
}

TEST(Assemble, RefusesWhatIsNoDomain) {
  EXPECT_NE(refused({}).find("no boundary"), std::string::npos);
  EXPECT_NE(refused({closed("thin", {{0, 0}, {1, 0}})}).find("'thin'"), std::string::npos);
  EXPECT_NE(refused({closed("dot", {{2, 3}, {2, 3}, {2, 3}})}).find("(2, 3)"), std::string::npos);
  EXPECT_NE(refused({closed("flat", {{0, 0}, {1, 0}, {2, 0}})}).find("'flat'"), std::string::npos);
}

TEST(Assemble, RefusesALooseEndWithItsPlace) {
  const std::string message =
      refused({open("coast", {{0, 0}, {1, 0}, {1, 1}}), open("sea", {{1, 1}, {0, 1}, {0, 2e-9}})});
  EXPECT_NE(message.find("'coast'"), std::string::npos) << message;
  EXPECT_NE(message.find("(0, 0)"), std::string::npos) << message;
  EXPECT_NE(message.find("watertight"), std::string::npos) << message;
  EXPECT_NE(message.find("'sea'"), std::string::npos) << "the near miss is named: " << message;
}

TEST(Assemble, RefusesThreeEndsAtOnePoint) {
  const std::string message =
      refused({open("a", {{0, 0}, {1, 0}, {1, 1}}), open("b", {{1, 1}, {0, 1}, {0, 0}}),
               open("c", {{0, 0}, {0.5, 0.5}, {1, 1}})});
  EXPECT_NE(message.find("3 chains end at (0, 0)"), std::string::npos) << message;
}

TEST(Assemble, RefusesCoordinatesThatAreNotFinite) {
  const std::string message =
      refused({closed("bad", {{0, 0}, {1, 0}, {1, std::numeric_limits<double>::quiet_NaN()}})});
  EXPECT_NE(message.find("'bad': point 3 is (1, nan)"), std::string::npos) << message;
}

TEST(Assemble, NestsByExactSidesThroughVertices) {
  // The inner loop's leftmost points lie level with vertices of the outer ones.
  std::vector<Chain> chains{square("sea", {0, 0}, 64)};
  for (int ring = 1; ring <= 30; ++ring)
    chains.push_back(
        closed("diamond", {{-2.0 * ring, 0}, {0, -2.0 * ring}, {2.0 * ring, 0}, {0, 2.0 * ring}}));
  const Geometry g = assembled(chains);
  for (std::int32_t loop = 1; loop <= 30; ++loop)
    EXPECT_EQ(loop_area(g, loop) > 0, (31 - loop) % 2 == 0) << loop;
}

TEST(Assemble, JoinsEndsThatDifferByRounding) {
  const double ulp = 4 * std::numeric_limits<double>::epsilon();  // of coordinates from 4 to 8
  const Chain low{"low", true, {{0, 4}, {0, 0}, {8, 0}, {8, 4}}, "a:1"};
  const auto with_end = [](double x) { return Chain{"high", true, {{x, 4}, {4, 8}, {0, 4}}, "a:2"}; };
  Warnings warnings;
  const Geometry geometry = assemble({low, with_end(8 - 3 * ulp)}, {}, warnings);
  EXPECT_EQ(geometry.loop_count(), 1);
  EXPECT_EQ(geometry.size(), 5);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].find("1 pair of chain ends was no farther apart than 8e-09"), 0u) << warnings[0];
  EXPECT_NE(warnings[0].find("the first at (8, 4)"), std::string::npos) << warnings[0];
  EXPECT_THROW(assemble({low, with_end(8 - 1e-8)}, {}, warnings), InputError) << "more than a billionth of 8";
  const Chain third{"third", true, {{8 + ulp, 4}, {9, 9}, {10, 4}}, "a:3"};
  EXPECT_THROW(assemble({low, with_end(8 - ulp), third}, {}, warnings), InputError) << "which of three?";
}

TEST(Assemble, ClosesAChainWhoseEndsDifferByRounding) {
  Warnings warnings;
  const Geometry geometry =
      assemble({{"ring", true, {{0.1, 0.3}, {1, 0}, {1, 1}, {0.1 + 1e-16, 0.3}}, "a:1"}}, {}, warnings);
  EXPECT_EQ(geometry.size(), 3);
  EXPECT_EQ(warnings.size(), 1u);
}

TEST(Assemble, NoNameStandsForABaffleAndSomethingElse) {
  const auto refused_lines = [](std::vector<LineRule> lines, const std::string& box = "box") {
    AssembleOptions options;
    options.lines = std::move(lines);
    Warnings warnings;
    return refusal([&] { assemble({square(box, {0, 0}, 1)}, options, warnings); });
  };
  const LineRule baffle{"plate", {}, {{-0.5, 0}, {0.5, 0}}, true, "case:3"};
  LineRule other{"plate__right", {}, {{-0.5, 0.5}, {0.5, 0.5}}, false, "case:8"};
  const std::string rest = "the right side of baffle 'plate' (case:3); give one of them another name";
  EXPECT_EQ(refused_lines({baffle, other}), "case:8: 'plate__right' is also the name of " + rest);
  EXPECT_EQ(refused_lines({other, baffle}), "case:8: 'plate__right' is also the name of " + rest);
  EXPECT_NE(refused_lines({baffle}, "plate__right").find("'plate__right' is also the name of " + rest),
            std::string::npos);
  other.name = "plate";
  EXPECT_EQ(
      refused_lines({baffle, other}),
      "case:8: line 'plate' has the name of a line of another kind (case:3); give one of them another name");
  other.baffle = true;
  AssembleOptions options;
  options.lines = {baffle, other};
  Warnings warnings;
  EXPECT_NO_THROW(assemble({square("box", {0, 0}, 1)}, options, warnings));
}

}  // namespace
}  // namespace quadloop
