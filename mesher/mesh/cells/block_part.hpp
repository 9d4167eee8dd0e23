#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/node_exchange.hpp"

namespace quadloop {

/// The part of a distributed mesh in one block, as a mesh of its own. Nodes, cells and boundary edges are in
/// the order of the whole mesh. An edge between two blocks is a boundary edge of both parts, directed with
/// the part to its left. Strips are left out.
struct BlockPart {
  Mesh mesh;
  std::vector<NodeId> nodes;        ///< the whole mesh's numbers of the part's owned nodes
  std::vector<std::int32_t> cells;  ///< the whole mesh's numbers of the part's cells, triangles before quads
};

/// Cuts the parts of blocks out of a distributed mesh.
class BlockCutter {
 public:
  /// `blocks` are those of the mesh's cells. All three must outlive the object. *Collective.*
  BlockCutter(const Communicator& comm, const Mesh& mesh, const MeshBlocks& blocks);

  /// *Collective.*
  BlockPart cut(std::int32_t block) const;

 private:
  std::vector<std::int32_t> blocks_of(const std::vector<std::int64_t>& cells) const;
  void take_cells(std::int32_t block, BlockPart& part) const;
  void take_edges(std::int32_t block, Mesh& part) const;
  NodeFlags nodes_used_by(const Mesh& part) const;
  void take_nodes(BlockPart& part) const;

  const Communicator& comm_;
  const Mesh& mesh_;
  const MeshBlocks& blocks_;
  NodeOwners owners_;
  NodeExchange ghosts_;
  std::vector<std::int32_t> left_, right_;  ///< block beside each boundary edge; -1: none
};

/// One part for each block of `mesh.blocks`, in their order. *Collective.*
std::vector<BlockPart> block_parts(const Communicator& comm, const Mesh& mesh);

/// Returns the field on a part: rows of its owned nodes and of its cells.
Field field_on(const BlockPart& part, const Field& field);

/// Whether the domain consists of several blocks.
inline bool has_blocks(const Mesh& mesh) { return mesh.blocks.names.size() > 1; }

/// Returns what `of_mesh(mesh, field)` computes for each cell, separately in each block. *Collective.*
template <class T, class OfMesh>
std::vector<T> cells_by_block(const Communicator& comm, const Mesh& mesh, const Field& field,
                              const OfMesh& of_mesh) {
  if (!has_blocks(mesh)) return of_mesh(mesh, field);
  std::vector<T> of_cells(mesh.cell_count());
  for (const BlockPart& part : block_parts(comm, mesh)) {
    const std::vector<T> of_part = of_mesh(part.mesh, field_on(part, field));
    for (std::size_t i = 0; i < of_part.size(); ++i) of_cells[part.cells[i]] = of_part[i];
  }
  return of_cells;
}

}  // namespace quadloop
