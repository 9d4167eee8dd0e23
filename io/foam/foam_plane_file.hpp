#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/file_mesh.hpp"
#include "io/model/loaded_mesh.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Writes a plane mesh as a polyMesh of one layer of thickness 1 along z, its ends "back" and "front" empty
/// (write_foam()). Boundary edges between two cells are no patch. *Collective.* Throws OutputError on all
/// ranks.
void write_foam_plane(OutputSet& outputs, const Mesh& mesh, const std::string& path);

/// The same for a mesh that the set's only rank holds, its blocks as zones of cells.
void write_foam_plane(OutputSet& outputs, const LoadedMesh& whole, const std::string& path);

}  // namespace quadloop
