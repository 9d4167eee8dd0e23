// What Open MPI is told where no launcher started the process.
#include "app/mpi_singleton.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "flow/command/environment.hpp"

namespace quadloop::app {
namespace {

constexpr const char* daemon = "OMPI_MCA_ess_singleton_isolated";
constexpr const char* folder = "OMPI_MCA_orte_create_session_dirs";
constexpr const char* network = "OMPI_MCA_pml";
constexpr const char* transfer = "OMPI_MCA_btl";
constexpr const char* devices = "HWLOC_PLUGINS_PATH";

std::string value_of(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "none";
}

class MpiSingletonTest : public testing::Test {
 protected:
  void SetUp() override { forget(); }
  void TearDown() override { forget(); }

 private:
  /// Also of what MPI_Init has set in the test itself.
  static void forget() {
    std::vector<std::string> names{daemon, folder, network, transfer, devices};
    for (char** entry = environ; *entry != nullptr; ++entry) {
      const std::string name = std::string(*entry).substr(0, std::string(*entry).find('='));
      if (flow::set_by_launcher(name)) names.push_back(name);
    }
    for (const std::string& name : names) unsetenv(name.c_str());
  }
};

TEST_F(MpiSingletonTest, NeedsNeitherADaemonNorANetworkAndLeavesNoSettings) {
  {
    const MpiSingleton settings;
    EXPECT_EQ(value_of(daemon), "1");
    EXPECT_EQ(value_of(folder), "0");
    EXPECT_EQ(value_of(network), "ob1");
    EXPECT_EQ(value_of(transfer), "self");
    EXPECT_EQ(value_of(devices), "/dev/null");
  }
  for (const char* name : {daemon, folder, network, transfer, devices}) EXPECT_EQ(value_of(name), "none");
}

TEST_F(MpiSingletonTest, LeavesWhatTheUserHasSet) {
  setenv(network, "ucx", 1);
  {
    const MpiSingleton settings;
    EXPECT_EQ(value_of(network), "ucx");
  }
  EXPECT_EQ(value_of(network), "ucx");
}

TEST_F(MpiSingletonTest, SaysNothingToOneOfALaunchersRanks) {
  setenv("PMI_RANK", "1", 1);
  const MpiSingleton settings;
  EXPECT_EQ(value_of(daemon), "none");
  EXPECT_EQ(value_of(network), "none");
}

}  // namespace
}  // namespace quadloop::app
