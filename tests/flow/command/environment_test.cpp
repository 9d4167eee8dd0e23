// The launcher's variables go, the user's stay.
#include "flow/command/environment.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace quadloop::flow {
namespace {

std::ptrdiff_t times(const std::vector<std::string>& environment, const std::string& entry) {
  return std::count(environment.begin(), environment.end(), entry);
}

TEST(Environment, LauncherVariablesAreKnown) {
  for (const char* name : {"OMPI_COMM_WORLD_RANK",
                           "OMPI_UNIVERSE_SIZE",
                           "OMPI_MCA_orte_hnp_uri",
                           "OMPI_MCA_ess",
                           "OMPI_MCA_ess_base_vpid",
                           "OMPI_MCA_initial_wdir",
                           "OMPI_MCA_pmix",
                           "OMPI_FILE_LOCATION",
                           "OMPI_ARGV",
                           "OMPI_COMMAND",
                           "OMPI_APP_CTX_NUM_PROCS",
                           "OMPI_NUM_APP_CTX",
                           "OMPI_FIRST_RANKS",
                           "OMPI_MCA_rmaps_base_mapping_policy",
                           "PMIX_RANK",
                           "PMIX_SERVER_URI2",
                           "PMI_RANK",
                           "PMI_FD",
                           "PRTE_LAUNCHED",
                           "ORTE_SCHIZO_DETECTION",
                           "HYDI_CONTROL_FD"})
    EXPECT_TRUE(set_by_launcher(name)) << name;
}

TEST(Environment, UserVariablesAreKept) {
  for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMPI_MCA_btl",
                           "OMPI_MCA_btl_vader_single_copy_mechanism", "OMPI_MCA_rmaps_base_oversubscribe",
                           "OMPI_MCA_osc", "PMIX_MCA_gds", "PRTE_MCA_x", "OPAL_PREFIX", "PATH", "HOME",
                           "SLURM_JOB_ID", "OMP_NUM_THREADS", "WM_PROJECT_DIR"})
    EXPECT_FALSE(set_by_launcher(name)) << name;
}

TEST(Environment, TellsWhetherALauncherStartedThisProcess) {
  const bool before = started_by_launcher();
  setenv("PMI_RANK", "0", 1);
  EXPECT_TRUE(started_by_launcher());
  unsetenv("PMI_RANK");
  EXPECT_EQ(started_by_launcher(), before);
}

TEST(Environment, IsThatOfThisProcessCleaned) {
  setenv("OMPI_COMM_WORLD_RANK", "1", 1);
  setenv("OMPI_MCA_osc", "pt2pt", 1);
  setenv("PWD", "/elsewhere", 1);
  const std::vector<std::string> environment = environment_for("/a b");
  EXPECT_TRUE(started_by_mpirun());
  unsetenv("OMPI_COMM_WORLD_RANK");
  EXPECT_EQ(times(environment, "OMPI_COMM_WORLD_RANK=1"), 0);
  EXPECT_EQ(times(environment, "OMPI_MCA_osc=pt2pt"), 1);
  EXPECT_EQ(times(environment, "PWD=/a b"), 1);
  EXPECT_EQ(times(environment, "PWD=/elsewhere"), 0);
  EXPECT_EQ(times(environment, std::string("PATH=") + std::getenv("PATH")), 1);
}

TEST(Environment, LetsAnMpirunOfTheSolversRunAsThisUserOnSoManyRanks) {
  const char* const root = "OMPI_ALLOW_RUN_AS_ROOT=1";
  const char* const confirmed = "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1";
  const char* const crowded = "OMPI_MCA_rmaps_base_oversubscribe=1";
  for (const char* name :
       {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "OMPI_MCA_rmaps_base_oversubscribe"})
    unsetenv(name);
  const int as_root = geteuid() == 0 ? 1 : 0;
  EXPECT_EQ(times(environment_for("/a", 1), root), as_root);
  EXPECT_EQ(times(environment_for("/a", 1), confirmed), as_root);
  EXPECT_EQ(times(environment_for("/a", 1), crowded), 0);
  EXPECT_EQ(times(environment_for("/a", 2), crowded), 1);
  setenv("OMPI_MCA_rmaps_base_oversubscribe", "0", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  EXPECT_EQ(times(environment_for("/a", 2), crowded), 0) << "the user's own";
  EXPECT_EQ(times(environment_for("/a", 2), root), 1) << "once";
  unsetenv("OMPI_MCA_rmaps_base_oversubscribe");
}

}  // namespace
}  // namespace quadloop::flow
