#pragma once

#include <optional>
#include <string>

#include "io/model/mesh_of_file.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::io {

/// Whether a patch marks the mesh as a plane one that is one cell thick.
bool is_one_cell_thick(const FileMesh& mesh);

/// Returns the plane mesh of a 3D mesh with a single layer of cells between empty patches, across z, x or y:
/// its plane is then x-y, y-z, or x-z, as seen from the largest z or x, or the smallest y. Nodes are those of
/// the back in their order, with their own coordinates; prisms become triangles and hexahedra quads, in their
/// order, each starting with the first node of its back face; patches that are not empty become boundaries.
/// Throws InputError, with `path`, unless each cell is between two empty faces, one on each side, with its
/// other edges parallel to the axis to a millionth of its thickness. The cells' nodes must exist.
LoadedMesh plane_of_mesh3d(const FileMesh& mesh3d, const std::string& path);

}  // namespace quadloop::io
