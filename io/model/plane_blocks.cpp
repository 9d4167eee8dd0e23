#include "io/model/plane_blocks.hpp"

#include <string>

#include "mesher/mesh/block_runs.hpp"

namespace quadloop::io {

PlaneBlocks plane_blocks(const LoadedMesh& whole) {
  PlaneBlocks blocks{whole.block_names, whole.triangle_to_block, whole.quad_to_block};
  for (std::size_t b = blocks.names.size(); std::ssize(blocks.names) < whole.blocks; ++b)
    blocks.names.push_back("block_" + std::to_string(b + 1));
  return blocks;
}

MeshOrder order_along_tree(const LoadedMesh& whole, const std::vector<BlockRun>& runs) {
  return runs.empty() ? own_order(whole.mesh) : order_by_runs(whole.mesh, plane_blocks(whole), runs);
}

}  // namespace quadloop::io
