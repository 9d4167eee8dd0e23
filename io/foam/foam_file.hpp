#pragma once

#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop {

/// Writes the mesh as an OpenFOAM polyMesh, ASCII: the folder `path`, made where it is missing, with points,
/// faces, owner, neighbour and boundary, and cellZones where there are several blocks; the bytes are the same
/// on any number of ranks. A plane mesh becomes one layer of thickness 1 along z, and its boundary edges
/// between two cells no patch. Internal faces are in upper-triangular order. Of one layer the two ends are of
/// the type "empty", else "symmetryPlane"; walls are "wall", boundaries of symmetry "symmetry", all others
/// "patch". *Collective.* Throws OutputError on all ranks.
void write_foam(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// The names of patches there: plain_words().
std::vector<std::string> foam_patch_names(const std::vector<std::string>& names);

/// Reads such a folder on the calling rank alone, ASCII: cells of four to six faces that are tetrahedra,
/// pyramids, prisms or hexahedra. Its zones of cells are blocks. Throws InputError.
MeshOfFile read_foam(const std::string& path);

}  // namespace quadloop
