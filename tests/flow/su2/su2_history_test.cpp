// Forces and residual from SU2's history.
#include "flow/su2/su2_history.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace quadloop::flow {
namespace {

TEST(Su2History, ItsLastRowHasTheForces) {
  const Su2End end = end_of_history(
      "\"Inner_Iter\",   \"rms[Rho]\"   ,\"rms[P]\",   \"CD\"  ,  \"CL\"\n"
      "0, -1.5, -3, 0.5, 0.25\n"
      "1, -2.5, -4, 0.125, 0.375\n"
      "2, -5.5, -9, 0.0625, 0.3125\n");
  EXPECT_EQ(end.cl, 0.3125);
  EXPECT_EQ(end.cd, 0.0625);
  ASSERT_TRUE(end.residual);
  EXPECT_NEAR(*end.residual, 1e-4, 1e-18) << "of the density where there are two";
  EXPECT_EQ(end.log_residual, -5.5);
}

TEST(Su2History, WithoutADensityThePressureTells) {
  EXPECT_NEAR(end_of_history("rms[P]\n-1\n-3\n").residual.value_or(0), 1e-2, 1e-16);
}

TEST(Su2History, LeavesOutWhatItCannotRead) {
  EXPECT_EQ(end_of_history("").cl, std::nullopt);
  EXPECT_EQ(end_of_history("\"CL\"\n").cl, std::nullopt);
  const Su2End end = end_of_history("\"CL\",\"CD\"\n1,2\n3,nan\n7\n");
  EXPECT_EQ(end.cl, 3) << "of the last whole row";
  EXPECT_EQ(end.cd, std::nullopt);
  EXPECT_EQ(end.residual, std::nullopt);
  EXPECT_EQ(end.log_residual, std::nullopt);
}

TEST(Su2Log, ItsLastSentenceTellsWhetherItConverged) {
  EXPECT_EQ(converged_by_log("--- Solver Exit ---\nAll convergence criteria satisfied.\n+--+\n"), true);
  EXPECT_EQ(converged_by_log("\nMaximum number of iterations reached (ITER = 10) before convergence.\n"),
            false);
  EXPECT_EQ(converged_by_log("\nMaximum number of time iterations reached (TIME_ITER = 10).\n"),
            std::nullopt);
}

/// What SU2 8.1 itself wrote, of one run of tests/io/su2/recorded/flow.cfg and two others.
std::string recorded(const std::string& name) {
  std::ifstream file(std::string(QUADLOOP_SOURCE_DIR) + "/tests/io/su2/recorded/" + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Su2Log, ItsErrorTellsThatItDiverged) {
  EXPECT_TRUE(
      diverged_by_log("Error in \"void CSolver::SetResidual_RMS()\":\n---\n"
                      "SU2 has diverged (Residual > 10^20 detected).\n"));
  EXPECT_TRUE(diverged_by_log("SU2 has diverged (NaN detected).\n"));
  EXPECT_TRUE(diverged_by_log("FGMRES orthogonalization failed, linear solver diverged.\n"));
  EXPECT_FALSE(diverged_by_log("Error in \"void CConfig\":\nmarker wall has no condition\n"));
}

TEST(Su2Recorded, ItsHistoryAndLogsAreUnderstood) {
  const Su2End end = end_of_history(recorded("history.csv"));
  EXPECT_EQ(end.log_residual, -3.82194366);
  EXPECT_EQ(end.cd, 0.01666731592);
  EXPECT_EQ(converged_by_log(recorded("limit.log")), false);
  EXPECT_EQ(converged_by_log(recorded("converged.log")), true);
  EXPECT_EQ(converged_by_log(recorded("error.log")), std::nullopt);
}

}  // namespace
}  // namespace quadloop::flow
