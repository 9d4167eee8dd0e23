#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/model/loaded_mesh.hpp"

namespace quadloop::io {

/// Flags further nodes that must not move when the mesh from the file `path` is smoothed: those on periodic
/// sides and inner curves, named nodes, and those of the named boundaries, inner curves and blocks. `flags`
/// has a flag for each owned node, or is empty; it remains empty if no node of any rank is flagged. Returns
/// notes about the periodic sides, inner curves and named nodes. Throws InputError, on all ranks, if a name
/// does not exist in the mesh. *Collective.*
std::vector<std::string> fix_nodes(const Communicator& comm, const LoadedMesh& loaded,
                                   std::span<const std::string> names, const std::string& path,
                                   NodeFlags& flags);

/// Removes the nodes on the sides of pairs from the nodes on other periodic sides. *Collective.*
void separate_pairs(const Communicator& comm, LoadedMesh& loaded);

}  // namespace quadloop::io
