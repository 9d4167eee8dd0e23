// A configuration of SU2 with keys set anew: everything else stays as its user wrote it.
#include "flow/su2/su2_config.hpp"

#include <gtest/gtest.h>

#include "mesher/base/error.hpp"

namespace quadloop::flow {
namespace {

using Words = std::vector<std::string>;

const std::string given =
    "% A comment with KEY= value\n"
    "SOLVER= EULER   % and one behind\n"
    "\n"
    "mach_number =0.8\n"
    "OUTPUT_FILES= ( RESTART, \\\n"
    "   PARAVIEW )\n"
    "MARKER_FAR= (far,out)\n";

std::string refusal_of(const std::string& text) {
  try {
    const Su2Config config(text, "a.cfg");
  } catch (const InputError& error) {
    return error.what();
  }
  return "no refusal";
}

TEST(Su2Config, KnowsItsValues) {
  const Su2Config config(given, "a.cfg");
  EXPECT_EQ(config.value("SOLVER"), "EULER");
  EXPECT_EQ(config.value("MACH_NUMBER"), "0.8");
  EXPECT_EQ(config.value("KEY"), std::nullopt);
  EXPECT_EQ(config.words("OUTPUT_FILES"), (Words{"RESTART", "PARAVIEW"}));
  EXPECT_EQ(config.words("MARKER_FAR"), (Words{"far", "out"}));
  EXPECT_EQ(config.words("MARKER_SYM"), Words{});
}

TEST(Su2Config, ChangesOnlyWhatIsSet) {
  Su2Config config(given, "a.cfg");
  EXPECT_EQ(config.text(), given);
  config.set("MACH_NUMBER", "0.5");
  config.set("OUTPUT_FILES", "( RESTART )");
  config.set("RESTART_SOL", "NO");
  EXPECT_EQ(config.text(),
            "% A comment with KEY= value\nSOLVER= EULER   % and one behind\n\nMACH_NUMBER= 0.5\n"
            "OUTPUT_FILES= ( RESTART )\nMARKER_FAR= (far,out)\nRESTART_SOL= NO\n");
  EXPECT_EQ(config.value("MACH_NUMBER"), "0.5");
}

TEST(Su2Config, ReadsLinesOfOtherSystems) {
  EXPECT_EQ(Su2Config("SOLVER= EULER\r\nAOA= 1\r\n", "a.cfg").value("AOA"), "1");
  EXPECT_EQ(Su2Config("AOA= 1", "a.cfg").value("AOA"), "1");
}

TEST(Su2Config, RefusesWhatSu2Refuses) {
  EXPECT_EQ(refusal_of("A= 1\nB\n"), "a.cfg:2: expected KEY= value, found 'B'");
  EXPECT_EQ(refusal_of("A= \\\n 1\nB= 1\na= 2\n"), "a.cfg:4: A is there twice");
}

}  // namespace
}  // namespace quadloop::flow
