#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop {

/// Writes a mesh as a parallel VTK file of one piece: the piece as write_vtu() has it, as "NAME_0.vtu" beside
/// "NAME.pvtu", which lists its arrays. *Collective.* Throws OutputError on all ranks.
void write_pvtu(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Reads a parallel VTK file with all its pieces, each as read_vtu() does, on the calling rank alone: one
/// piece after the other, nodes at the same place made one, cells and faces that several pieces have (ghosts)
/// taken once. Throws InputError.
MeshOfFile read_pvtu(const std::string& path);

}  // namespace quadloop
