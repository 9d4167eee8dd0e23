#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::io {

/// One rank's part of a mesh from a file, or a whole mesh on one rank. Nodes and cells are in the order of
/// the file; each rank has an even share of them. Names and warnings are the same on all ranks.
struct LoadedMesh {
  Mesh mesh;
  std::int32_t blocks = 1;
  /// Of this rank's cells, from 0; over all ranks, the cells of a block are contiguous.
  std::vector<std::int32_t> triangle_to_block, quad_to_block;
  std::vector<std::string> block_names;
  std::vector<BoundaryEdges> inner_curves = {};  ///< named edges inside a block: not boundaries
  std::vector<NodeId> periodic_nodes = {};       ///< on sides that the file marks as periodic
  std::optional<Field> solution = {};            ///< rows of this rank's nodes and cells
  std::vector<std::string> warnings = {};  ///< what the reader reversed or omitted, with the file's name
};

/// Moves the inner curves to the boundaries of the mesh, where they are inner lines.
inline void list_inner_curves(LoadedMesh& loaded) {
  for (BoundaryEdges& curve : loaded.inner_curves) {
    curve.inner_line = true;
    loaded.mesh.boundaries.push_back(std::move(curve));
  }
  loaded.inner_curves.clear();
}

/// Name of a block, numbered from 0, for which a file has none: "domain" if it is the only one.
inline std::string usual_block_name(std::int32_t blocks, std::int32_t block) {
  return blocks == 1 ? "domain" : std::string("block_").append(std::to_string(block + 1));
}

/// Whether there are several blocks, or one with a name of its own.
inline bool has_named_blocks(const LoadedMesh& loaded) {
  return loaded.blocks > 1 || (!loaded.block_names.empty() && loaded.block_names[0] != "domain");
}

/// Returns the block of a cell; quads are numbered after triangles.
inline std::int32_t block_of_cell(const LoadedMesh& loaded, std::int32_t cell) {
  const std::int32_t triangles = static_cast<std::int32_t>(loaded.triangle_to_block.size());
  return cell < triangles ? loaded.triangle_to_block[cell] : loaded.quad_to_block[cell - triangles];
}

/// Returns the rows of one block's cells in their order; a cell has `width` entries in `rows`.
template <class T>
std::vector<T> rows_of_block(std::span<const T> rows, std::size_t width,
                             const std::vector<std::int32_t>& cell_to_block, std::int32_t block) {
  std::vector<T> found;
  for (std::size_t i = 0; i * width < rows.size(); ++i) {
    const auto row = rows.subspan(i * width, width);
    if (cell_to_block[i] == block) found.insert(found.end(), row.begin(), row.end());
  }
  return found;
}

/// Returns the cells of one block in their order.
template <class Cell>
std::vector<Cell> cells_of_block(const std::vector<Cell>& cells,
                                 const std::vector<std::int32_t>& cell_to_block, std::int32_t block) {
  return rows_of_block(std::span<const Cell>(cells), 1, cell_to_block, block);
}

}  // namespace quadloop::io
