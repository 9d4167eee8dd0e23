// What stands behind messages and records: tables of words, guesses for mistyped words, JSON. On one rank
// alone.
#include <gtest/gtest.h>

#include <limits>

#include "mesher/base/json.hpp"
#include "mesher/base/nearest_word.hpp"
#include "mesher/base/suffix.hpp"
#include "mesher/base/utf8.hpp"
#include "mesher/base/word_table.hpp"

namespace quadloop {
namespace {

TEST(WordTable, GivesWordsInTheirOrderAndTheirValues) {
  enum class Colour { red, blue };
  constexpr WordTable<Colour, 2> table{{{"blue", Colour::blue}, {"red", Colour::red}}};
  EXPECT_EQ(words_of(table), (std::vector<std::string>{"blue", "red"}));
  EXPECT_EQ(value_of(table, "red"), Colour::red);
  EXPECT_EQ(value_of(table, "blue"), Colour::blue);
  EXPECT_EQ(value_of(table, "Red"), std::nullopt);
  EXPECT_EQ(value_of(table, ""), std::nullopt);
}

TEST(Utf8, OtherTextIsTakenAsLatin1) {
  EXPECT_EQ(as_utf8("Fl\xc3\xbcgel"), "Fl\xc3\xbcgel");
  EXPECT_EQ(as_utf8("Fl\xfcgel"), "Fl\xc3\xbcgel");
  EXPECT_EQ(as_utf8("cut \xe2\x82"), "cut \xc3\xa2\xc2\x82");
  EXPECT_EQ(as_utf8(""), "");
}

TEST(Utf8, ControlCharactersReachNoTerminal) {
  EXPECT_EQ(printable("a\x1b[31mred\x07\x7f"), "a\\x1b[31mred\\x07\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m \xff"),
            "\\xc2\\x9b31m \\xff");
  EXPECT_EQ(printable("two\nlines\tand \xe2\x82\xac"), "two\nlines\tand \xe2\x82\xac");
}

TEST(Suffix, ComesInSmallLetters) {
  EXPECT_EQ(suffix_of("a/B.MSH"), ".msh");
  EXPECT_EQ(suffix_of("a.b/c"), "");
}

TEST(NearestWord, IsOneSlipForEachThirdOfTheWord) {
  const std::vector<std::string> words{"--window", "--output", "mesh", "min", "max"};
  EXPECT_EQ(nearest_word("--widow", words), "--window");
  EXPECT_EQ(nearest_word("--outptu", words), "--output");
  EXPECT_EQ(nearest_word("MEHS", words), "mesh");
  EXPECT_EQ(nearest_word("mim", words), "min");
  EXPECT_EQ(nearest_word("mi", words), "min");
  EXPECT_EQ(nearest_word("m", words), "");
  EXPECT_EQ(nearest_word("", words), "");
  EXPECT_EQ(nearest_word("--nonsense", words), "");
  EXPECT_EQ(nearest_word("maximum", words), "max");
  EXPECT_EQ(nearest_word("--win", words), "--window");
  EXPECT_EQ(nearest_word("mi--", words), "");
  EXPECT_EQ(guess_for("mesg", words), "; do you mean 'mesh'?");
  EXPECT_EQ(guess_for("solver", words), "");
}

TEST(Json, NumbersAreShortAndFinite) {
  EXPECT_EQ(json_of(0.1), "0.1");
  EXPECT_EQ(json_of(1.0), "1");
  EXPECT_EQ(json_of(1.0 / 3), "0.3333333333333333");
  EXPECT_EQ(json_of(std::numeric_limits<double>::infinity()), "null");
  EXPECT_EQ(json_of(std::numeric_limits<double>::quiet_NaN()), "null");
  EXPECT_EQ(json_of(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
  EXPECT_EQ(json_of(std::vector{1.5, 2.0}), "[1.5, 2]");
  EXPECT_EQ(json_of(std::optional<double>()), "null");
  EXPECT_EQ(json_of(true), "true");
}

TEST(Json, TextsAreEscapedAndLatinBytesAreLetters) {
  EXPECT_EQ(json_of("a \"b\" \\ \n"), R"("a \"b\" \\ \u000a")");
  EXPECT_EQ(json_of("\xC3\xA9"), "\"\xC3\xA9\"");
  EXPECT_EQ(json_of("\xE9"), R"("\u00e9")");
  EXPECT_EQ(json_of(std::vector<std::string>{"a", "b"}), R"(["a", "b"])");
}

TEST(Json, ObjectsKeepTheOrderOfTheirMembers) {
  JsonObject inner, object, more;
  EXPECT_EQ(object.text(), "{}");
  EXPECT_EQ(object.lines("  "), "{\n  }");
  object.add("b", "x");
  object.add("a", inner);
  more.add_raw("c", "[1]");
  object.append(more);
  EXPECT_EQ(object.text(), R"({"b": "x", "a": {}, "c": [1]})");
  EXPECT_EQ(object.lines("  "), "{\n    \"b\": \"x\",\n    \"a\": {},\n    \"c\": [1]\n  }");
}

}  // namespace
}  // namespace quadloop
