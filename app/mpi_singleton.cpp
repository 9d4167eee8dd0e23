#include "app/mpi_singleton.hpp"

#include <array>
#include <cstdlib>
#include <utility>

#include "flow/command/environment.hpp"

namespace quadloop::app {

namespace {

// Without the daemon all such processes would share one folder of Open MPI in /tmp, which the first one to
// end removes: so none is created. No network is used, and no graphics card or X display is queried for the
// topology: this takes a tenth of the startup time.
constexpr std::array<std::pair<const char*, const char*>, 5> settings{
    {{"OMPI_MCA_ess_singleton_isolated", "1"},
     {"OMPI_MCA_orte_create_session_dirs", "0"},
     {"OMPI_MCA_pml", "ob1"},
     {"OMPI_MCA_btl", "self"},
     {"HWLOC_PLUGINS_PATH", "/dev/null"}}};

}  // namespace

MpiSingleton::MpiSingleton() {
  if (flow::started_by_launcher()) return;
  for (const auto& [name, value] : settings) {
    if (std::getenv(name) != nullptr) continue;
    setenv(name, value, 1);
    set_.push_back(name);
  }
}

MpiSingleton::~MpiSingleton() {
  for (const char* name : set_) unsetenv(name);
}

}  // namespace quadloop::app
