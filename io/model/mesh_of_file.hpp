#pragma once

#include <string>
#include <variant>

#include "io/model/file_mesh.hpp"
#include "io/model/loaded_mesh.hpp"

namespace quadloop {

/// What the reader of a format returns: a plane mesh, cleaned up, or a 3D mesh.
using MeshOfFile = std::variant<LoadedMesh, FileMesh>;

/// A plane mesh in the form that readers fill.
FileMesh file_mesh_of(const LoadedMesh& loaded);

/// The way back: nothing is corrected (plane_mesh() does that).
LoadedMesh loaded_mesh_of(FileMesh file);

/// The plane mesh, also of a 3D mesh that is one cell thick (plane_of_solid()); throws InputError, with
/// `path`, where the file holds another 3D mesh.
LoadedMesh plane_of(MeshOfFile mesh, const std::string& path);

}  // namespace quadloop
