#pragma once

#include <cstdint>
#include <span>

#include "mesher/mesh/scatter_mesh.hpp"

namespace quadloop {

/// Distributes the blocks of the whole mesh on the root, as scatter_mesh() distributes its cells in the same
/// order. *Collective.*
inline MeshBlocks scatter_blocks(const Communicator& comm, const MeshBlocks& of_whole,
                                 const MeshOrder& order) {
  return {broadcast_words(comm, of_whole.names),
          scatter_ordered(comm, std::span<const std::int32_t>(of_whole.of_triangles), order.triangles),
          scatter_ordered(comm, std::span<const std::int32_t>(of_whole.of_quads), order.quads)};
}

}  // namespace quadloop
