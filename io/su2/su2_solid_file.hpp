#pragma once

#include <optional>
#include <string>

#include "io/files/output_file.hpp"
#include "io/solid/solid_stream.hpp"
#include "mesher/solid/solid_mesh.hpp"

namespace quadloop {

/// Writes the mesh as SU2 text of three dimensions; the bytes are the same on any number of ranks. Patches
/// become markers (su2_marker_names()); prisms have the order of a VTK wedge. SU2 turns the angle of attack
/// in the x-z plane: draw the mesh out along y for it. *Collective.* Throws OutputError on all ranks.
void write_su2_solid(OutputSet& outputs, const SolidStream& mesh, const std::string& path);

/// Reads a 3D SU2 mesh on the calling rank alone: tetrahedra, pyramids, prisms, hexahedra, markers of
/// triangles and quads, each zone a block; nothing where the file says that it has other dimensions. Throws
/// InputError "file:line: ...".
std::optional<SolidMesh> read_su2_solid(const std::string& path);

}  // namespace quadloop
