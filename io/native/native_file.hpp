#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/loaded_mesh.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// Writes a plane mesh as native text into the set, block by block, with its solution; the bytes are the same
/// on any number of ranks. Boundaries without edges are omitted. The solution must have a row for each owned
/// node. Throws OutputError on all ranks. *Collective.*
void write_native(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Reads a native mesh, with the solution if the file has one, on the calling rank only. Boundaries of the
/// same name are merged. Throws InputError "file:line: ..." on anything else; geometric errors are left to
/// validate().
LoadedMesh read_native(const std::string& path);

}  // namespace quadloop::io
