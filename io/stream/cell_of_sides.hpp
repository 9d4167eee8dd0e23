#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "io/model/file_mesh.hpp"

namespace quadloop::io {

/// A face of a cell, and whether its normal points out of the cell.
struct CellSide {
  FileBoundary::Face nodes;
  bool looks_out;
};

/// Returns the neighbour of `node` on a side that is not on the base; -1 if there is none.
std::int32_t opposite_node(std::span<const CellSide> sides, std::span<const std::int32_t> base,
                           std::int32_t node);

/// Adds the cell with these sides to a block of the mesh, as a tetrahedron, pyramid, prism or hexahedron.
/// Returns an error message if it is none of these, else an empty string.
std::string add_cell_of_sides(FileMesh& mesh, std::span<const CellSide> sides, std::int32_t block);

}  // namespace quadloop::io
