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

/// Adds the cell with these sides to the mesh, as a tetrahedron, pyramid, prism or hexahedron. What is wrong
/// where it is none of these; empty where nothing is.
std::string add_cell(SolidMesh& mesh, std::span<const CellSide> sides);

}  // namespace quadloop
