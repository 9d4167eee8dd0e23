// Rows of the table of keys: what they read, require and refuse.
#include "quadloop/case/key_table.hpp"

#include <gtest/gtest.h>

#include "tests/io/input/temporary_file.hpp"

namespace quadloop {
namespace {

enum class Colour { red, blue };

struct Options {
  double width = 2;
  std::optional<double> depth;
  int count = 3;
  bool shiny = false;
  Colour colour = Colour::red;
  Point place;
  std::vector<std::string> names;
};

struct Whole {
  Options inner;
};

const KeyTable<Options> options_keys{
    "sample",
    {key<&Options::width>("width", number(io::Range::positive()), "Width.",
                          {.needs = {{"mesh.type = \"hybrid\"", "it is that of squares"}}}),
     key<&Options::depth>("depth", number(), "Depth.",
                          {.needs = {{"no shiny"}}, .required = {{"how deep", "colour = \"blue\""}}}),
     key<&Options::count>("count", whole({0, 9}), "Count.",
                          {.needs = {{"shiny or colour = \"blue\"", "", "count > 5"}}}),
     key<&Options::shiny>("shiny", flag(), "Shine."),
     key<&Options::colour>("colour", choice<Colour>({{"red", Colour::red}, {"blue", Colour::blue}}),
                           "Colour."),
     key<&Options::place>("place", point(), "Place.", {.needs = {{"width < 4"}}}),
     key<&Options::names>("names", texts({"one", "two"}), "Names.")}};

class KeyTableTest : public ::testing::Test {
 protected:
  Options read(const std::string& keys, const std::string& more = "") {
    const io::CaseTable root = io::read_case(folder_.write("case.toml", "[sample]\n" + keys + more));
    Options options;
    options_keys.read(*root.table("sample"), options);
    return options;
  }
  std::string refused(const std::string& keys, const std::string& more = "") {
    return test::refusal(folder_, [&] { read(keys, more); });
  }

  test::InputFolder folder_;
};

TEST_F(KeyTableTest, EachKeySetsItsMember) {
  const Options options = read(
      "width = 3\ndepth = 4\ncount = 5\ncolour = \"blue\"\nplace = [1, 2]\nnames = [\"two\", \"one\"]\n");
  EXPECT_EQ(options.width, 3);
  EXPECT_EQ(options.depth, 4);
  EXPECT_EQ(options.count, 5);
  EXPECT_EQ(options.colour, Colour::blue);
  EXPECT_EQ(options.place, (Point{1, 2}));
  EXPECT_EQ(options.names, (std::vector<std::string>{"two", "one"}));
  EXPECT_TRUE(read("shiny = true\n").shiny);
  EXPECT_EQ(read("").width, 2);
}

TEST_F(KeyTableTest, TellsFormDefaultAndExampleOfItsKeys) {
  const std::vector<KeyText>& keys = options_keys.text().keys;
  EXPECT_EQ(keys[0].value, "number, above 0");
  EXPECT_EQ(keys[0].initial, "2");
  EXPECT_EQ(keys[1].initial, "") << "none";
  EXPECT_EQ(keys[2].value, "whole number, at least 0 and at most 9");
  EXPECT_EQ(keys[3].initial, "false");
  EXPECT_EQ(keys[4].value, "`red` or `blue`");
  EXPECT_EQ(keys[4].initial, "\"red\"");
  EXPECT_EQ(keys[4].example, "\"blue\"");
}

TEST_F(KeyTableTest, AnUnknownKeyHasANearestOneHereOrElsewhere) {
  EXPECT_EQ(refused("width = 0\nwitdh = 1\n"),
            "case.toml:3: unknown key 'sample.witdh'; known here: width, depth, count, shiny, colour, place, "
            "names; do you mean 'width'?");
  EXPECT_TRUE(refused("gradation = 1\n").ends_with("; do you mean 'spacing.gradation'?"));
  EXPECT_TRUE(refused("xyz = 1\n").ends_with("names")) << refused("xyz = 1\n");
}

TEST_F(KeyTableTest, WrongValuesAreRefused) {
  EXPECT_EQ(refused("width = 0\n"), "case.toml:2: 'sample.width' is 0, but must be above 0");
  EXPECT_EQ(refused("count = 1.5\n"), "case.toml:2: 'sample.count' must be a whole number, not 1.5");
  EXPECT_EQ(refused("colour = \"bleu\"\n"),
            "case.toml:2: 'sample.colour' is 'bleu', but must be one of: red, blue; do you mean 'blue'?");
  EXPECT_EQ(refused("names = [\"one\", \"tow\"]\n"),
            "case.toml:2: 'sample.names' is 'tow', but must be one of: one, two; do you mean 'two'?");
  EXPECT_EQ(refused("shiny = 1\n"), "case.toml:2: 'sample.shiny' must be true or false");
}

TEST_F(KeyTableTest, AKeyNeedsWhatItsRowSays) {
  EXPECT_EQ(refused("depth = 1\nshiny = true\n"),
            "case.toml:2: 'sample.depth' stands beside shiny; give one of them");
  EXPECT_EQ(refused("colour = \"blue\"\n"), "case.toml:1: 'sample.depth' is missing: how deep");
  EXPECT_NO_THROW(read("count = 5\n")) << "not when it is small";
  EXPECT_EQ(refused("count = 6\n"), "case.toml:2: 'sample.count' needs shiny or colour = \"blue\"");
  EXPECT_NO_THROW(read("count = 6\nshiny = true\n"));
  EXPECT_NO_THROW(read("count = 6\ncolour = \"blue\"\ndepth = 1\n"));
  EXPECT_NO_THROW(read("place = [0, 1]\n")) << "the default of width will do";
  EXPECT_EQ(refused("width = 4\nplace = [0, 1]\n"),
            "case.toml:3: 'sample.place' needs width < 4, but width = 4");
}

TEST_F(KeyTableTest, AKeyMayNeedOneOfAnotherTable) {
  EXPECT_NO_THROW(read("width = 1\n", "[mesh]\n"));
  EXPECT_NO_THROW(read("width = 1\n", "[mesh]\ntype = \"hybrid\"\n"));
  EXPECT_EQ(
      refused("width = 1\n", "[mesh]\ntype = \"metric\"\n"),
      "case.toml:2: 'sample.width' needs mesh.type = \"hybrid\", but mesh.type = \"metric\"; it is that of "
      "squares");
}

TEST_F(KeyTableTest, RowsServeAStructThatHasTheOptions) {
  const KeyTable<Whole> keys{"sample", options_keys.keys_of<&Whole::inner>()};
  Whole whole;
  keys.read(*io::read_case(folder_.write("case.toml", "[sample]\ncount = 4\n")).table("sample"), whole);
  EXPECT_EQ(whole.inner.count, 4);
  EXPECT_TRUE(keys.keys()[2].differs(whole, Whole{}));
  EXPECT_FALSE(keys.keys()[0].differs(whole, Whole{}));
  EXPECT_EQ(joined<Whole>({keys.keys(), keys.keys()}).size(), 14U);
}

}  // namespace
}  // namespace quadloop
