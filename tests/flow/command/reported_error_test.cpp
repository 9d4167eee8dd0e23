// The error that OpenFOAM or SU2 reports at the end of its log.
#include <gtest/gtest.h>

#include "flow/command/log_tail.hpp"
#include "tests/flow/command/solver_scripts.hpp"

namespace quadloop::flow {
namespace {

std::string error_in(const std::string& text, std::size_t length = 300) {
  const test::CycleFolder folder;
  folder.write("log", text);
  return reported_error(folder.file("log"), length);
}

TEST(ReportedError, OfFoamIsTheMessageAboveThePlaceInTheSource) {
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

TEST(ReportedError, OfSeveralRanksOfFoamIsThatOfOne) {
  EXPECT_EQ(
      error_in(
          "[1] \n[1] \n[0] \n[1] --> FOAM FATAL ERROR: \n[0] --> FOAM FATAL ERROR: \n[0] of zero\n[1] of "
          "one\n[1] \n[1]     From function x\n[1] more\nmpirun: rubbish\n"),
      "FOAM FATAL ERROR: of one");
}

TEST(ReportedError, OfSu2IsTheTextBetweenItsRulers) {
  const std::string ruler = std::string(73, '-') + "\n", exit = "----------- Error Exit -----------\n\n";
  EXPECT_EQ(error_in("| 12| -3.1|\n\n\nError in \"void CSolver::SetResidual_RMS(const CGeometry*)\": \n" +
                     ruler + "SU2 has diverged (Residual > 10^20 detected).\n" + exit +
                     "[host:1] 3 more processes have sent help message\nORTE_ERROR_LOG: unpack\n"),
            "SU2 has diverged (Residual > 10^20 detected).");
  EXPECT_EQ(error_in("Error in \"a\": \n" + ruler + "First line\nand the second.\n" + exit),
            "First line and the second.");
}

TEST(ReportedError, OfARecordedLogOfSu2IsItsMessage) {
  EXPECT_EQ(reported_error(std::string(QUADLOOP_SOURCE_DIR) + "/tests/io/su2/recorded/error.log"),
            "The configuration file doesn't have any definition for marker inlet");
}

TEST(ReportedError, OfOtherLogsIsNothing) {
  EXPECT_EQ(error_in("--> FOAM Warning : \nfine\n"), "");
  EXPECT_EQ(error_in(""), "");
  EXPECT_EQ(reported_error("/there/is/no/such/log"), "");
}

}  // namespace
}  // namespace quadloop::flow
