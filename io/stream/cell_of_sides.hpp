#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "io/model/file_mesh.hpp"

namespace quadloop {

/// A face of a cell, whether it looks out of the cell as it is written.
struct CellSide {
  FileBoundary::Face nodes;
  bool looks_out;
};

/// The node that a side has beside `node` and that is not of the base; -1 where there is none.
std::int32_t opposite_node(std::span<const CellSide> sides, std::span<const std::int32_t> base,
                           std::int32_t node);

/// Adds the cell with these sides to a block of the mesh, as a tetrahedron, pyramid, prism or hexahedron.
/// Returns what is wrong where it is none of these; empty where nothing is.
std::string add_cell_of_sides(FileMesh& mesh, std::span<const CellSide> sides, std::int32_t block);

}  // namespace quadloop
