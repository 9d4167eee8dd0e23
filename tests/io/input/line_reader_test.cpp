// Rows of a text file, their words and numbers. On one rank alone.
#include "io/input/line_reader.hpp"

#include <gtest/gtest.h>

#include "tests/io/input/temporary_file.hpp"

namespace quadloop::io {
namespace {

struct Rows {
  explicit Rows(const std::string& text) : reader{folder.write("a.geom", text)} {}
  std::string refusal(const std::function<void(LineReader&)>& call) {
    return test::refusal(folder, [&] { call(reader); });
  }
  test::InputFolder folder;
  LineReader reader;
};

TEST(LineReader, PassesOverCommentsAndBlankLines) {
  Rows rows("\xEF\xBB\xBF# head\n\n  a b\t# note\r\n \r\nc,d\r\n\x1a");
  ASSERT_TRUE(rows.reader.next());
  EXPECT_EQ(rows.reader.line(), 3);
  EXPECT_EQ(rows.reader.words(), (std::vector<std::string_view>{"a", "b"}));
  EXPECT_EQ(rows.reader.row(), "  a b\t");
  ASSERT_TRUE(rows.reader.next());
  EXPECT_EQ(rows.reader.words(), (std::vector<std::string_view>{"c", "d"})) << "commas part words";
  EXPECT_FALSE(rows.reader.next());
  EXPECT_FALSE(rows.reader.next());
  EXPECT_NE(rows.refusal([](LineReader& r) { r.require_next("a loop"); }).find("but a loop is missing"),
            std::string::npos);
}

TEST(LineReader, RowsMayLieAcrossThePiecesOfAFile) {
  std::string text;
  constexpr int count = 300000;  // more than a megabyte
  for (int i = 0; i < count; ++i) text += std::to_string(i) + ' ' + std::to_string(-i) + '\n';
  Rows rows(text + "# a row of its own: " + std::string(3 << 20, 'x') + "\nlast");
  for (int i = 0; i < count; ++i) {
    Point p;
    ASSERT_TRUE(i % 2 == 0 ? rows.reader.next_point(p) : rows.reader.next()) << i;
    if (i % 2 == 0) {
      EXPECT_EQ(p, (Point{1.0 * i, -1.0 * i}));
    } else {
      EXPECT_EQ(rows.reader.words()[0], std::to_string(i));
    }
    EXPECT_EQ(rows.reader.line(), i + 1);
  }
  ASSERT_TRUE(rows.reader.next());
  EXPECT_EQ(rows.reader.row(), "last");
  EXPECT_EQ(rows.reader.line(), count + 2);
  EXPECT_FALSE(rows.reader.next());
}

TEST(LineReader, OnlyRowsOfTwoFiniteNumbersArePoints) {
  for (const char* text : {"", "1", "1 2 3", "1 x", "1 nan", "inf 1", "1 1e999", "1 2 # note", "# note",
                           "1x 2", "1 2;", "1.5D0 2", "+1 2"}) {
    Rows rows(std::string(text) + "\n");
    Point p;
    EXPECT_FALSE(rows.reader.next_point(p)) << text;
    EXPECT_EQ(rows.reader.line(), 0) << text;
  }
  for (const char* text : {"1 2", " 1,\t2\r\n", "1e0 2.\f\n"}) {
    Rows rows(text);
    Point p;
    EXPECT_TRUE(rows.reader.next_point(p)) << text;
    EXPECT_EQ(p, (Point{1, 2})) << text;
    EXPECT_FALSE(rows.reader.next_point(p) || rows.reader.next());
  }
}

TEST(LineReader, ALastRowNeedsNoLineEnd) {
  Rows rows("1\n2");
  ASSERT_TRUE(rows.reader.next() && rows.reader.next());
  EXPECT_EQ(rows.reader.line(), 2);
  EXPECT_FALSE(Rows("").reader.next());
}

TEST(LineReader, NumbersMayHaveFortransExponent) {
  Rows rows("1.5 +2 1.0D-3 -1d2 1e-999 1E-400 1D-400 .5 5.");
  rows.reader.next();
  const std::vector<double> expected{1.5, 2, 1e-3, -100, 0, 0, 0, 0.5, 5};
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(rows.reader.real(i), expected[i]);
}

TEST(LineReader, WhatIsNoFiniteNumberIsRefusedWithItsPlace) {
  Rows rows("\n1.5x 1e999 nan +-1 inf");
  rows.reader.next();
  EXPECT_NE(rows.refusal([](LineReader& r) { r.real(0); }).find("a.geom:2: '1.5x' is not a number"),
            std::string::npos);
  EXPECT_NE(rows.refusal([](LineReader& r) { r.real(1); }).find("'1e999' is not a finite number"),
            std::string::npos);
  for (const std::size_t word : {2U, 3U, 4U})
    EXPECT_NE(rows.refusal([&](LineReader& r) { r.real(word); }), "");
  EXPECT_FALSE(rows.reader.is_number(0));
  EXPECT_FALSE(rows.reader.is_number(3));
  EXPECT_TRUE(rows.reader.is_number(1) && rows.reader.is_number(2)) << "of any kind";
}

TEST(LineReader, CountsAreWholeAndAtLeastOne) {
  Rows rows("12 0 -1 1.0 99999999999999999999");
  rows.reader.next();
  EXPECT_EQ(rows.reader.count(0, "points"), 12);
  for (const std::size_t word : {1U, 2U, 3U, 4U})
    EXPECT_NE(rows.refusal([&](LineReader& r) { r.count(word, "points"); }).find("is not a number of points"),
              std::string::npos);
}

TEST(LineReader, DecimalCommasAreNotFourWords) {
  for (const char* row : {"0,5 1,5", "0,5\t1", "0,5; 1,5"}) {
    Rows rows(row);
    EXPECT_NE(rows.refusal([](LineReader& r) { r.next(); }).find("0,5: a decimal comma; write 0.5"),
              std::string::npos)
        << row;
  }
  for (const char* row : {"1, 2", "1,2", "1, 2, 3", "a,b c", "1,2 3,4 5,6"}) {
    Rows rows(row);
    EXPECT_TRUE(rows.reader.next()) << row;
  }
}

}  // namespace
}  // namespace quadloop::io
