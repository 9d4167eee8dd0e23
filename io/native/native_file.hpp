#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/loaded_mesh.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop {

/// Writes a plane mesh as native text into the set, block by block, with its solution; the bytes are the same
/// on any number of ranks. A boundary without edges on any rank is left out. The solution has a row for each
/// owned node. *Collective.* Throws OutputError on all ranks.
void write_native(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Reads a native mesh, with the solution if the file has one, on the calling rank alone. Boundaries of the
/// same name become one. Throws InputError "file:line: ..." on anything that is not such a mesh; geometric
/// faults are left to validate().
LoadedMesh read_native(const std::string& path);

}  // namespace quadloop
