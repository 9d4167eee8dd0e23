#pragma once

#include <optional>
#include <string>

#include "io/files/output_file.hpp"
#include "io/solid/solid_stream.hpp"
#include "mesher/solid/solid_mesh.hpp"

namespace quadloop {

/// Writes the mesh as a parallel VTK file of one piece: the piece as write_vtu_solid() has it, as
/// "NAME_0.vtu" beside "NAME.pvtu". *Collective.* Throws OutputError on all ranks.
void write_pvtu_solid(OutputSet& outputs, const SolidStream& mesh, const std::string& path);

/// Reads a parallel VTK file with all its pieces, each as read_vtu_solid() does, on the calling rank alone:
/// one piece after the other, nodes at the same place made one, cells and faces that several pieces have
/// (ghosts) taken once; nothing where the first piece is no 3D mesh. Throws InputError.
std::optional<SolidMesh> read_pvtu_solid(const std::string& path);

}  // namespace quadloop
