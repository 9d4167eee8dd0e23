#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/loaded_mesh.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop {

/// Writes a plane mesh as a .qmesh file (docs/reference/formats.md) into the set, with its blocks and its
/// solution: lines of text that say what follows, then nodes, cells, boundary edges and the solution as raw
/// bytes, each rank its own at once. The bytes are the same on any number of ranks. A boundary without edges
/// on any rank is left out. The solution has a row for each owned node. *Collective.* Throws OutputError on
/// all ranks.
void write_binary(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Reads such a file on the calling rank alone. Boundaries of the same name become one. Throws InputError on
/// anything that is not such a mesh; geometric faults are left to validate().
LoadedMesh read_binary(const std::string& path);

}  // namespace quadloop
