// Names from files in other codes and with control characters.
#include "io/text/clean_names.hpp"

#include <gtest/gtest.h>

namespace quadloop::io {
namespace {

struct Cleaned {
  std::vector<std::string> names, lines;
};

Cleaned cleaned(std::vector<std::string> names) {
  std::vector<std::string*> pointers;
  for (std::string& name : names) pointers.push_back(&name);
  std::vector<std::string> lines = clean_names(pointers, "a.msh");
  return {std::move(names), std::move(lines)};
}

TEST(CleanNames, GoodOnesStay) {
  const std::vector<std::string> names{"wall", "far field", "Fl\xc3\xbcgel", "", "wall"};
  EXPECT_EQ(cleaned(names).names, names);
  EXPECT_TRUE(cleaned(names).lines.empty());
}

TEST(CleanNames, OthersAreTakenAsLatin1WithoutControlCharacters) {
  const Cleaned result = cleaned({"Fl\xfcgel", "wall", "a\x1b[2Jb\n"});
  EXPECT_EQ(result.names, (std::vector<std::string>{"Fl\xc3\xbcgel", "wall", "a_[2Jb_"}));
  ASSERT_EQ(result.lines.size(), 1U);
  EXPECT_EQ(result.lines[0].find("a.msh: 2 names are not in UTF-8, or with control characters"), 0U)
      << result.lines[0];
}

TEST(CleanNames, DifferentNamesStayDifferentAndEqualOnesEqual) {
  EXPECT_EQ(cleaned({"a_b", "a\tb", "a\nb", "a\tb"}).names,
            (std::vector<std::string>{"a_b", "a_b_2", "a_b_3", "a_b_2"}));
}

}  // namespace
}  // namespace quadloop::io
