#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/reorder_mesh.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// Returns the runs of all ranks' triangles, then those of the quads, in the order of the mesh; empty if the
/// domain is one block. The same on every rank. *Collective.*
std::vector<BlockRun> block_runs(const Communicator& comm, const Mesh& mesh);

/// Returns the order, in the quadtree, of a mesh whose cells are sorted by block, as files store them. Throws
/// InputError on all ranks if a block has another number of cells than in the runs. Without runs, the mesh's
/// own order. *Collective.*
PartOrder order_by_runs(const Communicator& comm, const Mesh& mesh, const std::vector<BlockRun>& runs);

/// Sets the block of each of this rank's cells, whose order is that of the quadtree. *Collective.*
void set_blocks(const Communicator& comm, const std::vector<std::string>& names,
                const std::vector<BlockRun>& runs, Mesh& mesh);

}  // namespace quadloop
