#pragma once

#include <span>
#include <string>
#include <vector>

#include "io/model/loaded_mesh.hpp"

namespace quadloop {

/// Flags further nodes that must stay where they are when the mesh from the file `path` is smoothed: those of
/// periodic sides, of inner curves, and of the boundaries, inner curves and blocks of these names. `flags`
/// has a flag for each node, or none; it stays empty where no node is flagged. Returns notes of the first
/// two. Throws InputError where the mesh has nothing of a name.
std::vector<std::string> fix_nodes(const LoadedMesh& loaded, std::span<const std::string> names,
                                   const std::string& path, NodeFlags& flags);

}  // namespace quadloop
