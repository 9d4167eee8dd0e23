#include "flow/command/environment.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>

namespace quadloop::flow {

namespace {

// Open MPI 4 (found by comparing the environments inside and outside of mpirun) and 5, then PMI launchers:
// MPICH, Intel MPI, MVAPICH, Slurm, Cray.
constexpr auto launcher_prefixes =
    std::to_array<std::string_view>({"OMPI_COMM_WORLD_", "OMPI_APP_CTX_", "OMPI_MCA_orte_", "OMPI_MCA_ess",
                                     "OMPI_MCA_shmem_RUNTIME_", "OMPI_MCA_rmaps_ppr_", "OPAL_", "ORTE_",
                                     "PMIX_", "PRTE_", "PMI_", "PMI2_", "HYDI_", "MV2_COMM_WORLD_", "PALS_"});

constexpr auto launcher_variables = std::to_array<std::string_view>(
    {"OMPI_ARGV", "OMPI_COMMAND", "OMPI_FILE_LOCATION", "OMPI_FIRST_RANKS", "OMPI_NUM_APP_CTX",
     "OMPI_UNIVERSE_SIZE", "OMPI_MCA_initial_wdir", "OMPI_MCA_mpi_oversubscribe", "OMPI_MCA_pmix",
     "OMPI_MCA_rmaps_base_mapping_policy", "OMPI_MCA_rmaps_base_ranking_policy",
     "PMIX_MCA_mca_base_component_show_load_errors", "MPI_LOCALRANKID", "MPI_LOCALNRANKS"});

// Set by MPI_Init itself. A user's value of the same variable differs.
constexpr std::string_view set_by_mpi_init = "PMIX_MCA_psec=native";

// User settings among the prefixes above.
constexpr auto user_prefixes = std::to_array<std::string_view>({"PMIX_MCA_", "PRTE_MCA_", "OPAL_PREFIX"});

template <class Prefixes>
bool starts_with_any(std::string_view variable, const Prefixes& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](std::string_view prefix) { return variable.starts_with(prefix); });
}

}  // namespace

bool set_by_launcher(std::string_view variable) {
  if (std::find(launcher_variables.begin(), launcher_variables.end(), variable) != launcher_variables.end())
    return true;
  return starts_with_any(variable, launcher_prefixes) && !starts_with_any(variable, user_prefixes);
}

bool started_by_launcher() {
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    if (set_by_launcher(text.substr(0, text.find('=')))) return true;
  }
  return false;
}

bool started_by_mpirun() { return std::getenv("OMPI_COMM_WORLD_RANK") != nullptr; }

std::vector<std::string> environment_for(const std::string& folder, int ranks) {
  std::vector<std::string> environment;
  for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    const std::string_view name = text.substr(0, text.find('='));
    if (name == "PWD" || name == "OLDPWD" || text == set_by_mpi_init) continue;
    if (!set_by_launcher(name)) environment.emplace_back(text);
  }
  // programs that trust an inherited value would work in the wrong folder
  environment.push_back("PWD=" + folder);
  const auto add = [&](const std::string& name, const char* value) {
    if (std::getenv(name.c_str()) == nullptr) environment.push_back(name + "=" + value);
  };
  if (::geteuid() == 0) {
    add("OMPI_ALLOW_RUN_AS_ROOT", "1");
    add("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
  }
  if (ranks > 1) {
    add("OMPI_MCA_rmaps_base_oversubscribe", "1");                   // Open MPI 4
    add("PRTE_MCA_rmaps_default_mapping_policy", ":oversubscribe");  // Open MPI 5
  }
  return environment;
}

}  // namespace quadloop::flow
