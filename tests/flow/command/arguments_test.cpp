// Placeholders are filled in wherever they stand, and nothing else is touched.
#include <gtest/gtest.h>

#include "tests/flow/command/solver_scripts.hpp"

namespace quadloop::flow {
namespace {

using Arguments = std::vector<std::string>;

const SolverFiles files{
    "/run/cycle_03",         "/run/cycle_03/mesh.su2", "/run/cycle_03/out.csv", "/home/a b/case", 12, 3,
    "/run/cycle_03/mesh.csv"};

Arguments filled_in(const Arguments& arguments) { return filled({arguments, 1}, files); }

TEST(Arguments, AreFilledAnywhere) {
  EXPECT_EQ(
      filled_in({"{case}/run", "--mesh={mesh}", "{state}", "{solution}", "-n{ranks}", "{cycle}{cycle}"}),
      (Arguments{"/home/a b/case/run", "--mesh=/run/cycle_03/mesh.su2", "/run/cycle_03/mesh.csv",
                 "/run/cycle_03/out.csv", "-n12", "33"}));
}

TEST(Arguments, ValuesAreNotFilledAgain) {
  SolverFiles odd = files;
  odd.mesh = "/x/{cycle}";
  EXPECT_EQ(filled({{"a", "{mesh}"}, 1}, odd), (Arguments{"a", "/x/{cycle}"}));
}

TEST(Arguments, OtherTextStaysAsItIs) {
  const Arguments plain{"sh", "$(touch x); *", "{print $1}", "{}", "{", "}", "{ mesh}", "a}b{c", "", "'\"\\"};
  EXPECT_EQ(filled_in(plain), plain);
  EXPECT_EQ(filled_in({"a", R"({"ranks":{"all":{ranks}}})"}), (Arguments{"a", R"({"ranks":{"all":12}})"}));
}

TEST(Arguments, DoubledBracesStandForThemselves) {
  EXPECT_EQ(filled_in({"a", "${{HOME}}", "{{mesh}}{mesh}", "{{{cycle}}}"}),
            (Arguments{"a", "${HOME}", "{mesh}/run/cycle_03/mesh.su2", "{{cycle}}"}));
}

TEST(Arguments, UnknownNamesAreRefused) {
  const test::Refusal refusal = test::refusal_of([] { filled_in({"a", "--out={solutoin}"}); });
  EXPECT_EQ(refusal.status, ExitStatus::bad_input);
  EXPECT_EQ(refusal.message,
            "[solver] command: {solutoin} in the argument '--out={solutoin}' is unknown; there are {mesh}, "
            "{state}, {solution}, {case}, {ranks}, {cycle}, "
            "and {{solutoin}} stands for {solutoin} itself");
}

TEST(Arguments, NothingToRunIsRefused) {
  EXPECT_EQ(test::refusal_of([] { filled_in({}); }).status, ExitStatus::bad_input);
  EXPECT_EQ(test::refusal_of([] { filled_in({"a", std::string("b\0c", 3)}); }).status, ExitStatus::bad_input);
}

}  // namespace
}  // namespace quadloop::flow
