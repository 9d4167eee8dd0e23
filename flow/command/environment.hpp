#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace quadloop::flow {

/// Whether an MPI launcher sets this variable for the processes that it starts; a solver, or its own mpirun,
/// would take itself for part of quadloop's run. User settings (OMPI_ALLOW_RUN_AS_ROOT, OMPI_MCA_btl...) do
/// not count. Of Open MPI's parameters that may be either, those that place ranks on machines and all of
/// OMPI_MCA_orte_ count as the launcher's.
bool set_by_launcher(std::string_view variable);

/// Whether this process has variables of a launcher.
bool started_by_launcher();

/// Whether Open MPI's mpirun (or its daemon on this machine) started this process.
bool started_by_mpirun();

/// Returns this process's environment, as NAME=value, without the launcher's variables and with PWD =
/// `folder`. Unless the user has set the corresponding variables, an Open MPI mpirun started by the solver
/// may run as root if this process does and, with `ranks` above 1, may oversubscribe the cores.
std::vector<std::string> environment_for(const std::string& folder, int ranks = 1);

}  // namespace quadloop::flow
