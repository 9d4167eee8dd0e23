#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/loaded_mesh.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// Writes a plane mesh as a .qmesh file (docs/reference/formats.md) into the set, with its blocks and its
/// solution: a text header, then nodes, cells, boundary edges and the solution as raw bytes, written by all
/// ranks concurrently. The bytes are the same on any number of ranks. Boundaries without edges are omitted.
/// The solution must have a row for each owned node. Throws OutputError on all ranks. *Collective.*
void write_binary(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Reads such a file, each rank its even share of every array. Boundaries of the same name are merged. Throws
/// InputError on anything else, on all ranks; geometric errors are left to validate(). *Collective.*
LoadedMesh read_binary(const Communicator& comm, const std::string& path);

}  // namespace quadloop::io
