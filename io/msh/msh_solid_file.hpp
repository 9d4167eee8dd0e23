#pragma once

#include <optional>
#include <string>

#include "io/files/output_file.hpp"
#include "io/msh/msh_file.hpp"
#include "io/solid/solid_stream.hpp"
#include "mesher/solid/solid_mesh.hpp"

namespace quadloop {

/// Writes the mesh as Gmsh's MSH text; the bytes are the same on any number of ranks. Patches are
/// physical surfaces, the cells the physical volume "domain", or one for each block, block by block; names as
/// write_msh() has them. *Collective.*
/// Throws OutputError on all ranks.
void write_msh_solid(OutputSet& outputs, const SolidStream& mesh, const std::string& path,
                     MshVersion version = MshVersion::msh_2_2);

/// Reads a 3D mesh of Gmsh, MSH 2.2 or 4.1 text, on the calling rank alone; nothing where it has no cells of
/// three dimensions. Physical surfaces become patches, physical volumes blocks; without a physical group a
/// patch is "boundary_<tag of the surface>". Points and lines are passed over. Throws InputError "file:line:
/// ...".
std::optional<SolidMesh> read_msh_solid(const std::string& path);

}  // namespace quadloop
