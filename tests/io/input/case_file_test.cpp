#include "io/input/case_file.hpp"

#include <gtest/gtest.h>

#include "tests/io/input/temporary_file.hpp"

namespace quadloop::io {
namespace {

class CaseFile : public ::testing::Test {
 protected:
  CaseTable read(const std::string& text, const std::vector<std::string>& assignments = {}) {
    return read_case(folder_.write("case.toml", text), assignments);
  }
  std::string refused(const std::function<void()>& call) { return test::refusal(folder_, call); }

  test::InputFolder folder_;
};

TEST_F(CaseFile, GivesTypedValues) {
  const CaseTable root = read("title = \"x\"\n[spacing]\nmin = 1\nmax = 2.5\nlist = [1, 2.0]\n");
  const CaseTable spacing = *root.table("spacing");
  EXPECT_EQ(root.text("title"), "x");
  EXPECT_EQ(spacing.number("min"), 1.0);
  EXPECT_EQ(spacing.number("max"), 2.5);
  EXPECT_EQ(spacing.numbers("list", 2), (std::vector<double>{1, 2}));
  EXPECT_EQ(spacing.number("absent"), std::nullopt);
  EXPECT_EQ(spacing.whole("min", {}), 1);
  EXPECT_EQ(spacing.whole("absent", {}), std::nullopt);
  EXPECT_EQ(spacing.json("list"), "[1, 2]");
  EXPECT_EQ(spacing.root().text("title"), "x");
}

TEST_F(CaseFile, WholeNumbersOfAnySizeAreNumbers) {
  const CaseTable root = read("a = 9223372036854775807\nb = 9007199254740993\n");
  EXPECT_EQ(root.number("a"), 0x1p63);
  EXPECT_EQ(root.number("b"), 0x1p53) << "the nearest one";
  EXPECT_EQ(root.values({}), (std::vector<std::pair<std::string, std::string>>{{"a", "9.223372036854776e+18"},
                                                                               {"b", "9007199254740992"}}));
}

TEST_F(CaseFile, OneValueOrAList) {
  const CaseTable root =
      read("a = \"x\"\nb = [\"x\", \"y\"]\nc = 1\nd = [1, 2]\ne = [1, 2]\nf = [[1, 2], [3, 4]]\n");
  EXPECT_EQ(root.texts("a"), std::vector<std::string>{"x"});
  EXPECT_EQ(root.texts("b"), (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(root.numbers_or_one("c"), std::vector<double>{1});
  EXPECT_EQ(root.numbers_or_one("d"), (std::vector<double>{1, 2}));
  EXPECT_EQ(root.pairs("e").size(), 1u);
  EXPECT_EQ(root.pairs("f").size(), 2u);
}

TEST_F(CaseFile, NamesWrongTypes) {
  const CaseTable root = read("a = \"1\"\nb = 1\nc = [1, \"x\"]\nd = true\ne = 1\n");
  EXPECT_EQ(refused([&] { root.number("a"); }), "case.toml:1: 'a' must be a number, not a text");
  EXPECT_EQ(refused([&] { root.text("b"); }),
            "case.toml:2: 'b' must be a text in quotes, not a whole number");
  EXPECT_EQ(refused([&] { root.numbers("c", 2); }), "case.toml:3: 'c' must be a number, not a text");
  EXPECT_EQ(refused([&] { root.numbers("c", 3); }),
            "case.toml:3: 'c' is a list of 2, but must be a list of 3 numbers");
  EXPECT_EQ(refused([&] { root.number("d"); }), "case.toml:4: 'd' must be a number, not true or false");
  EXPECT_EQ(refused([&] { root.table("e"); }), "case.toml:5: 'e' must be a table [e], not a whole number");
}

TEST_F(CaseFile, NamesValuesOutOfRange) {
  const CaseTable root = read("a = 0\nb = nan\nc = 3\nd = \"z\"\n");
  EXPECT_EQ(refused([&] { root.number("a", Range::positive()); }),
            "case.toml:1: 'a' is 0, but must be above 0");
  EXPECT_EQ(refused([&] { root.number("b"); }), "case.toml:2: 'b' is nan, but must be finite");
  EXPECT_EQ(refused([&] {
              root.number("c", {1, 2, true, false});
            }),
            "case.toml:3: 'c' is 3, but must be above 1 and at most 2");
  EXPECT_EQ(refused([&] {
              root.known_word("d", "z", {"x", "y"});
            }),
            "case.toml:4: 'd' is 'z', but must be one of: x, y");
  EXPECT_EQ(root.known_word("d", "y", {"x", "y"}), "y");
  EXPECT_EQ(refused([&] { read("a = 1.5\n").whole("a", {}); }),
            "case.toml:1: 'a' must be a whole number, not 1.5");
}

TEST_F(CaseFile, ListsTablesInTheOrderOfTheFile) {
  const CaseTable root = read("[b.zebra]\n[b.\"isl_*\"]\n[b.ape]\n[[s]]\nx = 1\n[[s]]\nx = 2\n");
  EXPECT_EQ(root.table("b")->keys(), (std::vector<std::string>{"zebra", "isl_*", "ape"}));
  const auto tables = root.tables("s");
  ASSERT_EQ(tables.size(), 2u);
  EXPECT_EQ(tables[1].number("x"), 2.0);
}

TEST_F(CaseFile, SetOverridesAndAdds) {
  const CaseTable root = read("[spacing]\nmin = 1\n", {"spacing.min=2", "spacing.max=3", "title=a b",
                                                       "mesh.type=\"hybrid\"", "boundary.isl_*.spacing=4"});
  EXPECT_EQ(root.table("spacing")->number("min"), 2.0);
  EXPECT_EQ(root.table("spacing")->number("max"), 3.0);
  EXPECT_EQ(root.text("title"), "a b");
  EXPECT_EQ(root.table("mesh")->text("type"), "hybrid");
  EXPECT_EQ(root.table("boundary")->table("isl_*")->number("spacing"), 4.0);
}

TEST_F(CaseFile, SetErrorsNameTheirText) {
  const CaseTable root = read("[spacing]\nmin = 1\n[[source]]\nspacing = 1\n",
                              {"spacing.min=-2", "spacing.foo=1", "source.0.spacing=0"});
  const CaseTable spacing = *root.table("spacing");
  EXPECT_EQ(refused([&] { spacing.number("min", Range::positive()); }),
            "--set spacing.min=-2: 'spacing.min' is -2, but must be above 0");
  EXPECT_EQ(spacing.place("foo"), "--set spacing.foo=1");
  EXPECT_EQ(refused([&] { root.tables("source")[0].number("spacing", Range::positive()); }),
            "--set source.0.spacing=0: 'source.0.spacing' is 0, but must be above 0");
  EXPECT_NE(refused([&] { read("a = 1\n", {"a"}); }).find("--set a: has no '='"), std::string::npos);
  EXPECT_NE(refused([&] { read("a = 1\n", {"a.b=2"}); }).find("--set a.b=2"), std::string::npos);
  EXPECT_NE(refused([&] { read("a = 1\n", {"a..b=2"}); }).find("not a key"), std::string::npos);
  EXPECT_EQ(refused([&] { read("a = 1\n", {"a.b=2"}); }),
            "--set a.b=2: 'a' is a single value, not a table with 'b'");
  EXPECT_EQ(
      refused([&] { read("[[t.s]]\n", {"t.s.x=2"}); }),
      "--set t.s.x=2: 't.s' is a list of tables; select an entry by its number from 0, as in t.s.0.x, or "
      "replace the list, as in --set 't.s=[{...}]'");
  for (const std::string key : {"s[0]", "s[0].x"})
    EXPECT_EQ(
        refused([&] { read("[[s]]\n", {key + "=2"}); }).find("--set " + key + "=2: 's[0]' is no key; select"),
        0u);
  EXPECT_EQ(refused([&] { read("a = [1, 2]\n", {"a.x=2"}); }),
            "--set a.x=2: 'a' is a list; replace it as a whole, as in --set 'a=[...]'");
  EXPECT_NE(refused([&] { read("[[s]]\n", {"s.4.x=2"}); }).find("--set s.4.x=2"), std::string::npos);
  EXPECT_EQ(refused([&] { read("a = 1\n", {"s.0.x=2"}).tables("s"); }),
            "--set s.0.x=2: 's' has nothing in the case file that --set could change; write a [[s]] there "
            "first (the first is number 0)");
}

TEST_F(CaseFile, NamesTheLineThatIsNotToml) {
  EXPECT_EQ(refused([&] { read("a = 1\nb = = 2\n"); }).find("case.toml:2: "), 0u);
  EXPECT_EQ(refused([&] { read("a = 1\na = 2\n"); }).find("case.toml:2: "), 0u);
  EXPECT_EQ(refused([&] {
              read_case((folder_.path() / "none.toml").string());
            }).find("none.toml: cannot be opened"),
            0u);
  EXPECT_NE(refused([&] { read_case(folder_.path().string()); }).find("folder"), std::string::npos);
}

TEST_F(CaseFile, HintsAtMissingQuotes) {
  const auto ends_in = [&](const std::string& text, const std::string& end) {
    const std::string said = refused([&] { read(text); });
    EXPECT_TRUE(said.ends_with(end)) << said;
  };
  ends_in("a = 1\n[boundary.*]\n", "; quote it: [boundary.\"*\"]");
  ends_in("[boundary.isl_?]\n", "; quote it: [boundary.\"*\"]");
  ends_in("a = 1\nbc = wall # here\n", "; put text in quotes: \"wall\"");
  ends_in("bc=farfield\r\n", "; put text in quotes: \"farfield\"");
  ends_in("bc = none", "; put text in quotes: \"none\"");
  ends_in("formats = [mesh, cgns]\n", "; put text in quotes: \"mesh\"");
  ends_in("a = 0,1\n", "; 0,1: a decimal comma; write 0.1");
  ends_in("a = 0,1,2\n", ")");
  ends_in("a = true x\n", ")");
  ends_in("[\"is_*\"\n", ")");
}

}  // namespace
}  // namespace quadloop::io
