#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop {

/// Writes a plane mesh as a polyMesh of one layer of thickness 1 along z, its ends "back" and "front" empty
/// (write_foam()), its blocks as zones of cells. Boundary edges between two cells are no patch. *Collective.*
/// Throws OutputError on all ranks.
void write_foam_plane(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

}  // namespace quadloop
