#pragma once

#include <string>
#include <variant>

#include "io/model/file_mesh.hpp"
#include "io/model/loaded_mesh.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::io {

/// Result of the reader of a format: a cleaned-up plane mesh, or a 3D mesh.
using MeshOfFile = std::variant<LoadedMesh, FileMesh>;

/// Converts a plane mesh to the form that readers fill.
FileMesh file_mesh_of(const LoadedMesh& loaded);

/// Inverse conversion, without corrections (see plane_mesh()).
LoadedMesh loaded_mesh_of(FileMesh file);

/// Returns the plane mesh, also from a 3D mesh that is one cell thick (plane_of_mesh3d()). Throws InputError,
/// with `path`, for any other 3D mesh.
LoadedMesh plane_of(MeshOfFile mesh, const std::string& path);

/// Distributes a mesh that is whole on the root if it is a plane one; a 3D mesh remains on the root, and the
/// other ranks get an empty one. *Collective.*
MeshOfFile distributed(const Communicator& comm, MeshOfFile whole);

}  // namespace quadloop::io
