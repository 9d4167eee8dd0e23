#include "mesher/geometry/assemble/stray_chains.hpp"

#include <gtest/gtest.h>

#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/geometry/assemble/curved_chain.hpp"
#include "tests/geometry/outlines.hpp"

namespace quadloop {
namespace {

Chain drawn(const std::string& name, std::vector<Point> points) {
  return {name, true, std::move(points), "a.dxf:7: layer '" + name + "', LINE of handle 2F", false};
}

std::vector<Chain> square() {
  return {drawn("wall", {{0, 0}, {4, 0}}), drawn("wall", {{4, 0}, {4, 4}}),
          drawn("wall", {{4, 4}, {0, 4}, {0, 0}})};
}

struct Left {
  explicit Left(std::vector<Chain> given, const std::string& far_field = "") : chains{std::move(given)} {
    leave_out_strays(chains, far_field, warnings);
  }
  std::vector<Chain> chains;
  std::vector<std::string> warnings;
};

TEST(StrayChains, CentreLinesAreLeftOutAndNamed) {
  std::vector<Chain> chains = square();
  chains.insert(chains.begin() + 1, drawn("CENTER", {{-1, 2}, {5, 2}}));
  chains.push_back(drawn("CENTER", {{2, -1}, {2, 5}}));
  const Left left(chains);
  EXPECT_EQ(left.chains.size(), 3u);
  ASSERT_EQ(left.warnings.size(), 1u);
  EXPECT_EQ(left.warnings[0].find(
                "left out 2 lines that join no other line: a.dxf:7: layer 'CENTER', LINE of handle 2F; "
                "a.dxf:7: layer 'CENTER', LINE of handle 2F; if"),
            0u)
      << left.warnings[0];
  Warnings warnings;
  EXPECT_EQ(assemble(chains, {}, warnings).size(), 4) << "crossings with the outline do not matter";
  for (int i = 0; i < 7; ++i) chains.push_back(drawn("CENTER", {{-1, 2.1 + 0.1 * i}, {5, 2.1 + 0.1 * i}}));
  EXPECT_NE(Left(chains).warnings.at(0).find("; and 4 more;"), std::string::npos);
}

TEST(StrayChains, AnArcMayBeStray) {
  std::vector<Chain> chains = square();
  Chain arc = drawn("CENTER", {{1, 0}});
  append_arc(arc, {{0, 0}, {1, 0}, {0, 1}, 0, 1});
  chains.push_back(arc);
  EXPECT_EQ(Left(chains).chains.size(), 3u);
  Chain almost = drawn("wall", {{1, 0}});
  append_arc(almost, {{0, 0}, {1, 0}, {0, 1}, 0, 4});
  chains.back() = almost;
  EXPECT_EQ(Left(chains).chains.size(), 4u) << "it may be an outline that lacks a line";
}

TEST(StrayChains, PartsOfAnOutlineWithAGapStay) {
  std::vector<Chain> chains = square();
  const Chain airfoil = drawn("airfoil", {{3, 2.01}, {2, 2.2}, {1, 2}, {2, 1.8}, {3, 1.99}});
  chains.push_back(airfoil);
  EXPECT_EQ(Left(chains).chains.size(), 4u) << "an open trailing edge";
  chains.back() = drawn("airfoil", {{3, 2.01}, {1, 2}});
  chains.push_back(drawn("airfoil", {{1, 2}, {3, 1.99}}));
  EXPECT_EQ(Left(chains).chains.size(), 5u) << "they meet at the nose";
  chains.back() = drawn("airfoil", {{1, 1.995}, {3, 1.99}});
  EXPECT_EQ(Left(chains).chains.size(), 5u) << "they nearly meet at both ends";
  Warnings warnings;
  EXPECT_THROW(assemble(chains, {}, warnings), InputError);
}

TEST(StrayChains, SomethingMustBeLeft) {
  const std::vector<Chain> walls{drawn("wall", {{0, 0}, {4, 0}}), drawn("wall", {{0, 1}, {4, 1}})};
  EXPECT_EQ(Left(walls).chains.size(), 2u);
  std::vector<Chain> in_far_field = walls;
  in_far_field.push_back({"farfield", false, {{-9, -9}, {9, -9}, {9, 9}, {-9, 9}}, "case.toml:3"});
  EXPECT_EQ(Left(in_far_field, "case.toml:3").chains.size(), 3u);
  EXPECT_EQ(Left(in_far_field).chains.size(), 1u);
}

TEST(StrayChains, FilesThatDefineADirectionAreTakenAtTheirWord) {
  std::vector<Chain> chains = square();
  chains.push_back(drawn("wall", {{-1, 2}, {5, 2}}));
  chains.back().directed = true;
  EXPECT_EQ(Left(chains).chains.size(), 4u);
}

}  // namespace
}  // namespace quadloop
