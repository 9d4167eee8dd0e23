// The cause of an end of OpenFOAM's, of a log's end.
#include <gtest/gtest.h>

#include "flow/command/log_tail.hpp"
#include "tests/flow/command/solver_scripts.hpp"

namespace quadloop::flow {
namespace {

std::string error_in(const std::string& text, std::size_t length = 300) {
  const test::CycleFolder folder;
  folder.write("log", text);
  return foam_error(folder.file("log"), length);
}

TEST(FoamError, IsTheMessageAboveThePlaceInTheSource) {
  const std::string log =
      "Time = 1\n\n\n--> FOAM FATAL IO ERROR: \nCannot find patchField entry for square\n\nfile: 0/p from "
      "line "
      "3.\n\n    From function x()\n    in file y.C at line 9.\n\nFOAM exiting\n\n";
  EXPECT_EQ(error_in(log),
            "FOAM FATAL IO ERROR: Cannot find patchField entry for square file: 0/p from line 3.");
  EXPECT_EQ(error_in(log, 10), "FOAM FATAL...");
  EXPECT_EQ(error_in("--> FOAM FATAL ERROR: (openfoam-2312)\nno\n\n    in file y\n"),
            "FOAM FATAL ERROR: (openfoam-2312) no");
}

TEST(FoamError, OfSeveralRanksIsThatOfOne) {
  EXPECT_EQ(
      error_in(
          "[1] \n[1] \n[0] \n[1] --> FOAM FATAL ERROR: \n[0] --> FOAM FATAL ERROR: \n[0] of zero\n[1] of "
          "one\n[1] \n[1]     From function x\n[1] more\nmpirun: rubbish\n"),
      "FOAM FATAL ERROR: of one");
}

TEST(FoamError, OfOtherLogsIsNothing) {
  EXPECT_EQ(error_in("--> FOAM Warning : \nfine\n"), "");
  EXPECT_EQ(error_in(""), "");
  EXPECT_EQ(foam_error("/there/is/no/such/log"), "");
}

}  // namespace
}  // namespace quadloop::flow
