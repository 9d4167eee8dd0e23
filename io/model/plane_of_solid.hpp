#pragma once

#include <optional>
#include <string>

#include "io/model/mesh_of_file.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Whether some patch says that the mesh is a plane one, one cell thick.
bool is_one_cell_thick(const FileMesh& mesh);

/// The plane mesh of which a 3D one is one layer, between patches that are empty, across z, or x, or y: its
/// plane is then x-y, y-z, or x-z, as seen from the largest z or x, or the smallest y. Nodes are those of the
/// back in their order, with their own coordinates; prisms become triangles and hexahedra quads, in their
/// order, each from the first node of its back face on; patches that are not empty become boundaries. Throws
/// InputError, with `path`, where cells do not lie so: each between two empty faces, one on either side, its
/// other edges along the axis to a millionth of its thickness. The nodes that cells name must exist.
LoadedMesh plane_of_solid(const FileMesh& solid, const std::string& path);

}  // namespace quadloop
