// Tokens of a text, and where they stand; names told apart. On one rank alone.
#include "io/text/text_scanner.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "io/text/name_index.hpp"
#include "tests/io/input/temporary_file.hpp"

namespace quadloop::io {
namespace {

struct Scanned {
  explicit Scanned(const std::string& text, char comment = '#')
      : scan{folder.write("a.su2", text), comment} {}
  template <class Call>
  std::string refusal(const Call& call) {
    return test::refusal(folder, [&] { call(scan); });
  }
  test::InputFolder folder;
  TextScanner scan;
};

TEST(ParseReal, TakesOneWholeNumber) {
  double value = 0;
  const auto is = [&](std::string_view token, double expected) {
    return parse_real(token, value) && value == expected;
  };
  EXPECT_TRUE(is("1.5", 1.5) && is("+2", 2) && is("-3e-1", -0.3) && is("1.0D-03", 1e-3) && is("2d2", 200));
  EXPECT_TRUE(is("1e-400", 0)) << "what underflows is the nearest number";
  EXPECT_TRUE(is("1E-400", 0) && is("0." + std::string(400, '0') + "1", 0));
  EXPECT_TRUE(is("1e400", HUGE_VAL));
  EXPECT_TRUE(parse_real("nan", value) && std::isnan(value));
  for (const char* token : {"", "+", "1.5x", "0x10", "1,5", "1 ", "--1", "+-1", "e5"})
    EXPECT_FALSE(parse_real(token, value)) << token;
}

TEST(TextScanner, PassesOverCommentsAndBlanks) {
  Scanned s("# head\n a\t# not this\r\n\n 7 8.5\n# tail");
  EXPECT_EQ(s.scan.token("a word"), "a");
  EXPECT_EQ(s.scan.integer("a number"), 7);
  EXPECT_EQ(s.scan.real("a number"), 8.5);
  EXPECT_TRUE(s.scan.at_end());
}

TEST(TextScanner, RefusalsNameTheLineOfTheTokenReadLast) {
  Scanned s("1\n\n2 x\n0,5\n");
  EXPECT_EQ(s.scan.integer("n"), 1);
  EXPECT_EQ(s.scan.integer("n"), 2);
  EXPECT_NE(
      s.refusal([](TextScanner& t) { t.integer("a tag"); }).find("a.su2:3: expected a tag, found \"x\""),
      std::string::npos);
  EXPECT_NE(s.refusal([](TextScanner& t) { t.real("x"); }).find("0,5: a decimal comma; write 0.5"),
            std::string::npos);
  EXPECT_NE(
      s.refusal([](TextScanner& t) { t.token("a word"); }).find("the file ends where a word should follow"),
      std::string::npos);
  Scanned infinite("inf 99999999999999999999");
  EXPECT_NE(infinite.refusal([](TextScanner& t) { t.real("x"); }).find("x is not finite"), std::string::npos);
  EXPECT_NE(infinite.refusal([](TextScanner& t) { t.integer("a tag"); }), "");
}

TEST(TextScanner, CountsAreHeldAgainstWhatTheFileCanHold) {
  Scanned s("2\n1 2\n3 4");
  EXPECT_EQ(s.scan.count("rows", 2), 2U);
  for (const char* text : {"3\n1 2\n3 4", "-1", "4000000000 1"}) {
    Scanned wrong(text);
    EXPECT_NE(wrong.refusal([](TextScanner& t) { t.count("rows", 2); }), "") << text;
  }
}

TEST(TextScanner, KnowsTheEndOfTheLine) {
  Scanned s("a  b c # note\nd#e f\n");
  s.scan.token("a");
  EXPECT_FALSE(s.scan.at_line_end());
  EXPECT_EQ(s.scan.rest_of_line(), "b c");
  EXPECT_TRUE(s.scan.at_line_end());
  EXPECT_EQ(s.scan.rest_of_line(), "");
  EXPECT_EQ(s.scan.token("d"), "d#e") << "a comment begins a token";
  EXPECT_EQ(s.scan.rest_of_line(), "f");
}

TEST(TextScanner, GoesBackAndFindsComments) {
  Scanned s("# gamma 1.4\n1 # cell\n# other\n2");
  s.scan.integer("n");
  const std::size_t first = s.scan.place();
  s.scan.integer("n");
  EXPECT_EQ(s.scan.last_comment_with("gamma"), "# gamma 1.4");
  EXPECT_EQ(s.scan.last_comment_with("c"), "# cell") << "the last one";
  EXPECT_EQ(s.scan.last_comment_with("nothing"), "");
  s.scan.forget_comments();
  EXPECT_EQ(s.scan.last_comment_with("gamma"), "");
  s.scan.go_to(first);
  EXPECT_EQ(s.scan.integer("n"), 1);
}

TEST(NameIndex, NumbersNamesAsTheyCome) {
  NameIndex index;
  EXPECT_EQ(index.entry_of("b").number, 0);
  EXPECT_TRUE(index.entry_of("a").is_new);
  EXPECT_FALSE(index.entry_of("b").is_new);
  EXPECT_EQ(index.entry_of("a").number, 1);
}

TEST(DistinctNames, GiveTheFirstFreeSuffix) {
  DistinctNames names;
  names.reserve("a_2");
  const auto name = [&](const std::string& wanted) {
    return names.name(wanted, [&](const std::string& suffix) { return wanted + suffix; });
  };
  EXPECT_EQ(name("a"), "a");
  EXPECT_EQ(name("a"), "a_3") << "a_2 is taken";
  EXPECT_EQ(name("a"), "a_4");
  EXPECT_EQ(name("a_3"), "a_3_2");
  EXPECT_EQ(name(""), "");
  EXPECT_EQ(name(""), "_2");
}

}  // namespace
}  // namespace quadloop::io
