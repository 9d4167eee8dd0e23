// The end of a log, fit for one message.
#include "adapt/solver/log_tail.hpp"

#include <gtest/gtest.h>

#include "tests/adapt/solver/solver_scripts.hpp"

namespace quadloop {
namespace {

using Lines = std::vector<std::string>;

Lines tail_of(const std::string& text, std::size_t lines = 5, std::size_t length = 200) {
  const test::CycleFolder folder;
  folder.write("log", text);
  return last_lines(folder.file("log"), lines, length);
}

TEST(LogTail, IsTheLastLinesInOrder) {
  EXPECT_EQ(tail_of("1\n2\n3\n4\n5\n6\n7\n"), (Lines{"3", "4", "5", "6", "7"}));
  EXPECT_EQ(tail_of("1\n2"), (Lines{"1", "2"}));
  EXPECT_EQ(tail_of("a\n\n  \nb\n\n", 2), (Lines{"a", "b"}));
  EXPECT_EQ(tail_of("10 %\r20 %\rdead\r\n", 2), (Lines{"20 %", "dead"}));
}

TEST(LogTail, OfNothingIsNothing) {
  EXPECT_EQ(tail_of(""), Lines{});
  EXPECT_EQ(tail_of("\n\n \n"), Lines{});
  EXPECT_EQ(last_lines("/there/is/no/such/log"), Lines{});
}

TEST(LogTail, LongLinesAreCutBetweenCharacters) {
  EXPECT_EQ(tail_of("abcdef\nabc\n", 5, 3), (Lines{"abc...", "abc"}));
  EXPECT_EQ(tail_of("ab\u00e9d", 5, 3), Lines{"ab..."});
  EXPECT_EQ(tail_of("ab\u00e9d", 5, 4), Lines{"ab\u00e9..."});
}

TEST(LogTail, ControlCharactersAreNotPassedOn) { EXPECT_EQ(tail_of(std::string("a\tb\x1b[31mc\0d\n", 11)), Lines{"a b?[31mc?d"}); }

TEST(LogTail, OnlyTheEndIsRead) {
  const Lines tail = tail_of(std::string(3 << 20, 'x') + "\nend");
  ASSERT_EQ(tail.size(), 2U);
  EXPECT_EQ(tail[0], std::string(200, 'x') + "...");
  EXPECT_EQ(tail[1], "end");
}

}  // namespace
}  // namespace quadloop
