#pragma once

#include <optional>
#include <string>

#include "io/files/output_file.hpp"
#include "io/solid/solid_stream.hpp"
#include "mesher/solid/solid_mesh.hpp"

namespace quadloop {

/// Writes the mesh as a 3D mesh file of Fluent, ASCII, into the set; the bytes are the same on any number of
/// ranks. Nodes keep their numbers, and so do cells where there is one block; those of several stand block
/// by block, a zone each. A zone of faces for each patch, of its name and condition ("none" is a wall); each
/// face looks into its first cell. *Collective.* Throws OutputError on all ranks.
void write_fluent_solid(OutputSet& outputs, const SolidStream& mesh, const std::string& path);

/// Reads a mesh file of Fluent, ASCII, on the calling rank alone: cells of four to six faces that are
/// tetrahedra, pyramids, prisms or hexahedra. Zones of cells become blocks, zones of faces patches with their
/// conditions; faces between two cells are left out. Nothing where the file says that it has two dimensions.
/// Throws InputError "file:line: ..." also for meshes in binary, with hanging nodes or polyhedra.
std::optional<SolidMesh> read_fluent_solid(const std::string& path);

}  // namespace quadloop
