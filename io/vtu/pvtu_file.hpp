#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// Writes a mesh as a parallel VTK file with one piece: "NAME_0.vtu", written as by write_vtu(), and
/// "NAME.pvtu", which lists its arrays. Throws OutputError on all ranks. *Collective.*
void write_pvtu(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Reads a parallel VTK file with all its pieces, each as read_vtu() does, on the calling rank only: one
/// piece after another; coincident nodes are merged, and cells and faces in several pieces (ghosts) are kept
/// once. Throws InputError.
MeshOfFile read_pvtu(const std::string& path);

}  // namespace quadloop::io
