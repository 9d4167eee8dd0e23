#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// The part of a distributed mesh in one block, as a mesh of its own. An edge between two blocks is a
/// boundary edge of both parts, directed with the part to its left. Strips are left out.
struct BlockPart {
  Mesh mesh;
  std::vector<NodeId> nodes;        ///< the whole mesh's numbers of the part's owned nodes
  std::vector<std::int32_t> cells;  ///< the whole mesh's numbers of the part's cells, triangles before quads
};

/// One part for each block, in their order. *Collective.*
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
