#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "mesher/solid/solid_mesh.hpp"

namespace quadloop {

/// A face of a cell, whether it looks out of the cell as it is written.
struct CellSide {
  SolidPatch::Face nodes;
  bool looks_out;
};

/// The node that a side has beside `node` and that is not of the base; -1 where there is none.
std::int32_t opposite_node(std::span<const CellSide> sides, std::span<const std::int32_t> base,
                           std::int32_t node);

/// Adds the cell with these sides to the mesh, as a tetrahedron, pyramid, prism or hexahedron. What is wrong
/// where it is none of these; empty where nothing is.
std::string add_cell(SolidMesh& mesh, std::span<const CellSide> sides);

}  // namespace quadloop
