// Variables are found by their usual names, or the choice is left to the user. On one rank alone.
#include "mesher/mesh/variable_names.hpp"

#include <gtest/gtest.h>

#include "mesher/base/error.hpp"

namespace quadloop {
namespace {

using Names = std::vector<std::string>;

std::string refusal_of(const Names& names, const std::string& wanted) {
  try {
    variable(names, wanted, "s.vtu");
    return {};
  } catch (const InputError& fault) {
    return fault.what();
  }
}

TEST(VariableNames, FindsThemByUsualNames) {
  const Names su2{"Density", "Momentum_x", "Momentum_y", "Energy", "Pressure", "Mach"};
  EXPECT_EQ(variable(su2, "Density", "s"), 0U);
  EXPECT_EQ(variable(su2, "density", "s"), 0U);
  EXPECT_EQ(variable(su2, "rho", "s"), 0U);
  EXPECT_EQ(variable(su2, "y_momentum", "s"), 2U);
  EXPECT_EQ(variable(su2, "mach_number", "s"), 5U);
  const Names ours{"density", "x_velocity", "y_velocity", "pressure"};
  EXPECT_EQ(variable(ours, "VelocityX", "s"), 1U);
  EXPECT_EQ(variable(ours, "v", "s"), 2U);
  EXPECT_EQ(variable(Names{"Velocity:0", "Velocity:1", "p"}, "y_velocity", "s"), 1U);
  EXPECT_EQ(variable(Names{"P", "p"}, "p", "s"), 1U);  // as it is written, first of all
}

TEST(VariableNames, RefusesWithAList) {
  const Names names{"rho", "Density", "p"};
  EXPECT_EQ(refusal_of(names, "mach"), "s.vtu: no variable 'mach' in the solution; it has: rho, Density, p");
  EXPECT_EQ(refusal_of({}, "mach"), "s.vtu: no variable 'mach' in the solution; it has: none");
  EXPECT_EQ(variable(names, "density", "s"), 1U);
  EXPECT_NE(refusal_of({"u", "Ux"}, "x_velocity").find("'x_velocity' may be u or Ux"), std::string::npos);
}

TEST(VariableNames, TheNearestWayThatFindsAnyDecides) {
  EXPECT_EQ(variables_like(Names{"Rho", "rho", "density"}, "rho"), (std::vector<std::size_t>{1}));
  EXPECT_EQ(variables_like(Names{"RHO", "Rho", "density"}, "rho"), (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(variables_like(Names{"Static Pressure", "P"}, "pressure"), (std::vector<std::size_t>{0, 1}));
  EXPECT_TRUE(variables_like(Names{"speed"}, "pressure").empty());
}

TEST(Words, HoldNoBlanks) {
  EXPECT_EQ(word_of("wave height\t(m)"), "wave_height_(m)");
  EXPECT_EQ(word_of("\xC3\xA9\x7f"), "\xC3\xA9_");
  EXPECT_EQ(distinct_words(Names{"", "a b", ""}, "s"), (Names{"v1", "a_b", "v3"}));
  EXPECT_THROW(distinct_words(Names{"a b", "a_b"}, "s"), InputError);
  EXPECT_THROW(distinct_words(Names{"v2", ""}, "s"), InputError)
      << "a name given takes the place of one made up";
}

TEST(Distinct, TellsNamesByTheirLetters) {
  EXPECT_NO_THROW(require_distinct(Names{"p", "P", "p_", ""}, "s"));
  EXPECT_THROW(require_distinct(Names{"p", "q", "p"}, "s"), InputError);
}

}  // namespace
}  // namespace quadloop
