#pragma once

#include <string>

#include "adapt/plan.hpp"

namespace quadloop {

/// Throws InputError on all ranks unless the mesh can be the one that the tree was saved with: as many nodes and cells, and each leaf's cells within
/// two leaf sizes of it, which snapping, flips and smoothing keep. Bytes do not count: other formats round. `shown` names the mesh, `tree` the tree.
/// *Collective.*
void require_own_mesh(const Communicator& comm, const SolvedMesh& solved, const std::string& shown, const std::string& tree);

}  // namespace quadloop
