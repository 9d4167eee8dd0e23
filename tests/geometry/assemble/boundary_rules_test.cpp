#include "mesher/geometry/assemble/boundary_rules.hpp"

#include <gtest/gtest.h>

#include "tests/geometry/outlines.hpp"

namespace quadloop {
namespace {

TEST(BoundaryRules, MatchPatterns) {
  EXPECT_TRUE(matches("island_*", "island_001"));
  EXPECT_TRUE(matches("*", ""));
  EXPECT_TRUE(matches("*_?b*c", "a_xbbbc"));
  EXPECT_TRUE(matches("a", "a"));
  EXPECT_FALSE(matches("island_?", "island_001"));
  EXPECT_FALSE(matches("island_*", "island"));
  EXPECT_FALSE(matches("a", "ab"));
  EXPECT_FALSE(matches("", "a"));
}

TEST(BoundaryRules, ExactNamesWinOverPatterns) {
  BoundaryRule exact{"island_2", 0.5, {}, {}, "", true};
  BoundaryRule pattern{"island_*", 2.0, 45.0, BoundaryCondition::wall, "", true};
  const auto boundaries = boundaries_by_rules({"sea", "island_1", "island_2"}, {exact, pattern}, 30);
  EXPECT_EQ(boundaries[0].spacing, 0);
  EXPECT_EQ(boundaries[0].corner_degrees, 30);
  EXPECT_EQ(boundaries[0].condition, BoundaryCondition::none);
  EXPECT_EQ(boundaries[1].spacing, 2);
  EXPECT_EQ(boundaries[2].spacing, 0.5);
  EXPECT_EQ(boundaries[2].corner_degrees, 45);
  EXPECT_EQ(boundaries[2].condition, BoundaryCondition::wall);
}

TEST(BoundaryRules, LayersComeFromTheLastRuleThatAsksForThem) {
  BoundaryRule pattern, exact;
  pattern.pattern = "island_*";
  pattern.layers = LayerSpec{1, 1.2, 1.2, 10};
  exact.pattern = "island_2";
  exact.layers = LayerSpec{2, 1.2, 1.2, 10};
  BoundaryRule bare;
  bare.pattern = "island_1";
  const auto boundaries = boundaries_by_rules({"sea", "island_1", "island_2"}, {bare, exact, pattern}, 30);
  EXPECT_FALSE(boundaries[0].layers.has_value());
  EXPECT_EQ(boundaries[1].layers, pattern.layers);
  EXPECT_EQ(boundaries[2].layers, exact.layers);
}

TEST(BoundaryRules, RefuseWhatMatchesNothing) {
  const BoundaryRule rule{"isle_*", 2.0, {}, {}, "case.toml:7: [boundary.isle_*]", true};
  const std::string message = test::refusal([&] { boundaries_by_rules({"sea", "island_1"}, {rule}, 30); });
  EXPECT_EQ(message.find("case.toml:7"), 0u) << message;
  EXPECT_NE(message.find("island_1"), std::string::npos) << message;
}

TEST(BoundaryRules, PatternsLeaveWhatIsClaimed) {
  BoundaryRule pattern, ours, exact;
  pattern.pattern = "*";
  pattern.spacing = 0.1;
  pattern.condition = BoundaryCondition::wall;
  ours.pattern = "farfield";
  ours.condition = BoundaryCondition::farfield;
  ours.claims = true;
  exact.pattern = "farfield";
  exact.spacing = 2;
  const auto boundaries = boundaries_by_rules({"wing", "farfield"}, {ours, pattern}, 30);
  EXPECT_EQ(boundaries[0].condition, BoundaryCondition::wall);
  EXPECT_EQ(boundaries[1].condition, BoundaryCondition::farfield);
  EXPECT_EQ(boundaries[1].spacing, 0);
  EXPECT_EQ(boundaries_by_rules({"wing", "farfield"}, {ours, pattern, exact}, 30)[1].spacing, 2);
}

TEST(BoundaryRules, KnowBoundariesThatAreAddedLater) {
  BoundaryRule ours, exact;
  ours.pattern = exact.pattern = "axis";
  ours.must_match = false;
  ours.claims = true;
  EXPECT_EQ(boundaries_by_rules({"body"}, {ours, exact}, 30).size(), 1U);
  exact.pattern = "axs";
  const std::string message = test::refusal([&] { boundaries_by_rules({"body"}, {ours, exact}, 30); });
  EXPECT_NE(message.find("it has: body, axis; do you mean 'axis'?"), std::string::npos) << message;
}

}  // namespace
}  // namespace quadloop
