// Names of plain signs: what changes, and that none becomes another's.
#include "io/text/plain_names.hpp"

#include <gtest/gtest.h>

namespace quadloop::io {
namespace {

using Names = std::vector<std::string>;

TEST(PlainNames, KeepLettersDigitsAndFewSigns) {
  EXPECT_EQ(plain_names({"my wall", "a.b-c+d_e", "", "k\xc3\xbcste", "{x}"}),
            (Names{"my_wall", "a.b-c+d_e", "_", "k\xc3\xbcste", "_x_"}));
}

TEST(PlainNames, StayDifferent) {
  EXPECT_EQ(plain_names({"a b", "a_b", "a/b"}), (Names{"a_b", "a_b_2", "a_b_3"}));
}

TEST(PlainWords, BeginWithALetter) {
  EXPECT_EQ(plain_words({"1", "-a", "a1", "_1"}), (Names{"_1", "_-a", "a1", "_1_2"}));
}

}  // namespace
}  // namespace quadloop::io
