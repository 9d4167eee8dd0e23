#pragma once

#include <vector>

#include "io/model/extruded_mesh.hpp"
#include "io/model/loaded_mesh.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop::io {

/// Returns the blocks of a whole mesh; unnamed ones are named "block_2", ... by their number.
PlaneBlocks plane_blocks(const LoadedMesh& whole);

/// Returns the order of a file's cells along the quadtree of the mesh, given the runs in its tree file.
/// Throws InputError if the blocks have other numbers of cells.
MeshOrder order_along_tree(const LoadedMesh& whole, const std::vector<BlockRun>& runs);

}  // namespace quadloop::io
