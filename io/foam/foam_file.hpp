#pragma once

#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// Writes the mesh as an OpenFOAM polyMesh, ASCII: the folder `path`, created if missing, with points, faces,
/// owner, neighbour and boundary, and cellZones if there are several blocks; the bytes are the same on any
/// number of ranks. A plane mesh is extruded by one layer of thickness 1 along z; its boundary edges between
/// two cells are no patches. Inner faces are in upper-triangular order. Patch types: the two ends are "empty"
/// for one layer, else "symmetryPlane"; walls are "wall", symmetry boundaries "symmetry", all others "patch";
/// the entry physicalType is a condition that the type does not determine.
/// Throws OutputError on all ranks. *Collective.*
void write_foam(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Returns the names of patches in the file: plain_words().
std::vector<std::string> foam_patch_names(const std::vector<std::string>& names);

/// Reads a polyMesh folder, ASCII, on the calling rank only: cells of four to six faces that are tetrahedra,
/// pyramids, prisms or hexahedra. Cell zones become blocks. Throws InputError.
MeshOfFile read_foam(const std::string& path);

}  // namespace quadloop::io
