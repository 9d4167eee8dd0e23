// Inner lines in the comments of a native mesh file.
#include "io/model/line_text.hpp"

#include <gtest/gtest.h>

namespace quadloop::io {
namespace {

std::string lines(const std::string& count) {
  return "# other\n# inner line section " + count + "\n# 3 4\n#  4 7\n# strip wake\n";
}

TEST(LineText, IsReadAsWritten) {
  EXPECT_EQ(line_comment("section", 2), "# inner line section 2\n");
  const auto found = lines_in_comments(line_comment("a", 1) + "# 1 2\n" + lines("2"), 7);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_EQ(found[0].name, "a");
  EXPECT_EQ(found[1].name, "section");
  EXPECT_EQ(found[1].edges,
            (std::vector{std::array{NodeId{2}, NodeId{3}}, std::array{NodeId{3}, NodeId{6}}}));
}

TEST(LineText, DamagedLinesAreLeftOut) {
  EXPECT_TRUE(lines_in_comments(lines("3"), 7).empty()) << "an edge is missing";
  EXPECT_TRUE(lines_in_comments(lines("2"), 6).empty()) << "there is no node 7";
  EXPECT_TRUE(lines_in_comments(lines("x"), 7).empty());
  EXPECT_TRUE(lines_in_comments("# inner line a 1\n# 2 2\n", 7).empty());
  EXPECT_TRUE(lines_in_comments("# inner line a 1\n", 7).empty());
  EXPECT_TRUE(lines_in_comments("", 7).empty());
}

}  // namespace
}  // namespace quadloop::io
