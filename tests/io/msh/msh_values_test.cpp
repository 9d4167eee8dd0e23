// Values of an MSH file as columns of a solution.
#include "io/msh/msh_values.hpp"

#include <gtest/gtest.h>

namespace quadloop::io {
namespace {

MshValues section(const std::string& name, std::size_t width, std::vector<double> values) {
  MshValues made{name, width, {}, std::move(values)};
  for (std::size_t row = 0; row < made.values.size() / width; ++row)
    made.rows.add(10 * static_cast<std::int64_t>(row + 1));
  made.rows.sort();
  return made;
}

TEST(MshColumns, StandInTheOrderOfTheTags) {
  const std::vector<std::int64_t> tags{30, 10};
  std::vector<std::string> losses;
  const CellValues found =
      msh_columns({section("p", 1, {1, 2, 3}), section("u", 3, {1, 2, 0, 3, 4, 9, 5, 6, 0}),
                   section("w", 3, {1, 2, 3, 4, 5, 6, 7, 8, 9})},
                  tags, "nodes", losses);
  EXPECT_EQ(found.names, (std::vector<std::string>{"p", "u_x", "u_y", "w_x", "w_y", "w_z"}));
  EXPECT_EQ(found.values, (std::vector<double>{3, 5, 6, 7, 8, 9, 1, 1, 2, 1, 2, 3}));
  EXPECT_TRUE(losses.empty());
}

TEST(MshColumns, LeaveOutWhatIsNotWhole) {
  const std::vector<std::int64_t> tags{10, 20, 30};
  std::vector<std::string> losses;
  const CellValues found =
      msh_columns({section("p", 1, {1}), section("q", 1, {4, 5, 6})}, tags, "cells", losses);
  EXPECT_EQ(found.names, std::vector<std::string>{"q"});
  EXPECT_EQ(found.values, (std::vector<double>{4, 5, 6}));
  EXPECT_EQ(losses, std::vector<std::string>{"'p' has no values for 2 of the 3 cells, and is left out"});
}

}  // namespace
}  // namespace quadloop::io
