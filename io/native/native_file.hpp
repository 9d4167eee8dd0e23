#pragma once

#include <cstddef>
#include <string>

#include "io/files/output_file.hpp"
#include "io/files/reading/line_range.hpp"
#include "io/model/loaded_mesh.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// Writes a plane mesh as native text into the set, block by block, with its solution; the bytes are the same
/// on any number of ranks. Boundaries without edges are omitted. The solution must have a row for each owned
/// node. Throws OutputError on all ranks. *Collective.*
void write_native(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Reads a native mesh, with the solution if the file has one: each rank the lines in its range of bytes,
/// then the rows are distributed evenly. Nodes and cells are in the order of the file. Boundaries of the same
/// name are merged. Throws InputError "file:line: ..." of the first error in the file, on all ranks;
/// geometric errors are left to validate(). A rank holds `piece` bytes of the file at a time. *Collective.*
LoadedMesh read_native(const Communicator& comm, const std::string& path,
                       std::size_t piece = LineRange::usual_piece);

}  // namespace quadloop::io
