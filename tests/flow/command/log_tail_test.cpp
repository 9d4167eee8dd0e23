// The end of a log, fit for one message.
#include "flow/command/log_tail.hpp"

#include <gtest/gtest.h>

#include "tests/flow/command/solver_scripts.hpp"

namespace quadloop::flow {
namespace {

std::string tail_of(const std::string& text, std::size_t length = 200) {
  const test::CycleFolder folder;
  folder.write("log", text);
  return last_line(folder.file("log"), length);
}

TEST(LogTail, IsTheLastLineThatSaysSomething) {
  EXPECT_EQ(tail_of("1\n2\n3\n"), "3");
  EXPECT_EQ(tail_of("1\n2"), "2");
  EXPECT_EQ(tail_of("a\n\n  b \n\n \n"), "b");
  EXPECT_EQ(tail_of("10 %\r20 %\rdead\r\n"), "dead");
  EXPECT_EQ(tail_of("dead\n-------\n ~~~^^^^\n"), "dead");
  EXPECT_EQ(tail_of("\u00e9\n--\n"), "\u00e9");
}

TEST(LogTail, OfNothingIsNothing) {
  EXPECT_EQ(tail_of(""), "");
  EXPECT_EQ(tail_of("\n\n \n---\n"), "");
  EXPECT_EQ(last_line("/there/is/no/such/log"), "");
}

TEST(LogTail, LongLinesAreCutBetweenCharacters) {
  EXPECT_EQ(tail_of("abc\nabcdef\n", 3), "abc...");
  EXPECT_EQ(tail_of("ab\u00e9d", 3), "ab...");
  EXPECT_EQ(tail_of("ab\u00e9d", 4), "ab\u00e9...");
}

TEST(LogTail, ControlCharactersAreNotPassedOn) {
  EXPECT_EQ(tail_of(std::string("a\tb\x1b[31mc\0d\n", 11)), "a b?[31mc?d");
}

TEST(LogTail, OnlyTheEndIsRead) {
  EXPECT_EQ(tail_of("end\n" + std::string(3 << 20, '-')), "");
  EXPECT_EQ(tail_of(std::string(3 << 20, 'x')), std::string(200, 'x') + "...");
}

}  // namespace
}  // namespace quadloop::flow
