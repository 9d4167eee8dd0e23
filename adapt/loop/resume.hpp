#pragma once

#include <string>
#include <vector>

#include "adapt/loop/record.hpp"
#include "adapt/loop/settling.hpp"
#include "adapt/remesh/demands/solved_mesh.hpp"

namespace quadloop {

/// Looks whether a run can be gone on with after the whole cycle in `folder`, before any work. Throws
/// InputError that names the file and the cure where its record is not whole, or is of a case with another
/// outline or other settings: then with the key that has changed. Returns a warning for each setting that has
/// changed and may. `now` needs its digests and settings alone. *Collective.*
std::vector<std::string> require_same_run(const Communicator& comm, const std::string& folder,
                                          const CycleRecord& now);

/// The mesh, the tree and the solution of a cycle that an earlier run left, by its files. They are compared
/// with each other; a refusal says how to be rid of the damage. *Collective.*
SolvedMesh read_earlier_cycle(const Communicator& comm, const std::string& folder);

/// What an earlier run's record of the cycle in `folder` tells of forces and estimate. Throws InputError
/// where it cannot be read. *Collective.*
CycleValues read_earlier_values(const Communicator& comm, const std::string& folder);

}  // namespace quadloop
