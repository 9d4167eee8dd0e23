#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/solid/solid_stream.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Writes the mesh as a parallel VTK file of one piece: the piece as write_vtu() has it, as "NAME_0.vtu"
/// beside "NAME.pvtu", which lists its arrays. *Collective.* Throws OutputError on all ranks.
void write_pvtu(OutputSet& outputs, const Mesh& mesh, const std::string& path,
                const Field* solution = nullptr);

/// The same for a mesh that the set's only rank holds, with its blocks.
void write_pvtu(OutputSet& outputs, const LoadedMesh& whole, const std::string& path);

/// Writes a 3D mesh as a parallel VTK file of one piece: the piece as write_vtu_solid() has it, as
/// "NAME_0.vtu" beside "NAME.pvtu". *Collective.* Throws OutputError on all ranks.
void write_pvtu_solid(OutputSet& outputs, const SolidStream& mesh, const std::string& path);

/// Reads a parallel VTK file with all its pieces, each as read_vtu() does, on the calling rank alone: one
/// piece after the other, nodes at the same place made one, cells and faces that several pieces have (ghosts)
/// taken once. Throws InputError.
MeshOfFile read_pvtu(const std::string& path);

}  // namespace quadloop
