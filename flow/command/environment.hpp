#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace quadloop {

/// True for a variable that an MPI launcher gives to each process that it starts, and that would make a
/// solver, or an mpirun of its own, take itself for a part of quadloop's run. What a user sets
/// (OMPI_ALLOW_RUN_AS_ROOT, OMPI_MCA_btl...) is not among them. Of Open MPI's parameters that are both, those
/// that place ranks on machines and all of OMPI_MCA_orte_ count as the launcher's.
bool set_by_launcher(std::string_view variable);

/// True where a launcher's variables are set in this process.
bool started_by_launcher();

/// True where Open MPI's mpirun (or its daemon on this machine) started this process.
bool started_by_mpirun();

/// This process's environment, as NAME=value, without the launcher's variables and with PWD = `folder`. An
/// mpirun of Open MPI's that the solver begins with may run as root where this process is root, and, with
/// `ranks` above 1, may start more of them than there are cores, unless the user has set the variables that
/// say so.
std::vector<std::string> environment_for(const std::string& folder, int ranks = 1);

}  // namespace quadloop
