#pragma once

#include <string>
#include <vector>

#include "adapt/loop/convergence.hpp"
#include "adapt/loop/record.hpp"
#include "adapt/remesh/demands/solved_mesh.hpp"

namespace quadloop::adapt {

/// Checks, before any work, whether a run can be resumed after the complete cycle in `folder`. Throws
/// InputError that names the file and the remedy if its record is incomplete, or is of a case with another
/// geometry or other settings (it then names the changed key). Returns a warning for each changed setting
/// that may change. Of `now` only digests and settings are used. *Collective.*
std::vector<std::string> require_same_run(const Communicator& comm, const std::string& folder,
                                          const CycleRecord& now);

/// Reads mesh, tree and solution of a cycle of an earlier run and checks that they belong together. The error
/// message names the remedy. *Collective.*
SolvedMesh read_earlier_cycle(const Communicator& comm, const std::string& folder);

/// Returns forces and error estimate from the record of the cycle in `folder`. Throws InputError if it cannot
/// be read. *Collective.*
CycleValues read_earlier_values(const Communicator& comm, const std::string& folder);

}  // namespace quadloop::adapt
