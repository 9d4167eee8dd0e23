#pragma once

#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// Writes a 2D or 3D Fluent mesh file, ASCII, into the set; the bytes are the same on any number of ranks.
/// Nodes keep their numbers, and so do cells if there is one block; several blocks are written one after
/// another, a zone each. Each boundary is a zone of faces, with its name and condition ("none" is a wall). A
/// 2D edge has its first cell on its left, the normal of a 3D face points into its first cell. Throws
/// OutputError on all ranks. *Collective.*
void write_fluent(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Returns valid zone names: letters, digits and "_-.+".
std::vector<std::string> fluent_zone_names(const std::vector<std::string>& names);

/// Whether a file begins like a Fluent mesh file.
bool is_fluent(const std::string& path);

/// Reads a 2D or 3D Fluent mesh file, ASCII, on the calling rank only: triangles and quadrilaterals, or
/// tetrahedra, pyramids, prisms and hexahedra. Cell zones become blocks, face zones boundaries with their
/// conditions; faces inside a block are omitted. The first node of a 2D cell is arbitrary. A 2D mesh is
/// cleaned up by plane_mesh(). Throws InputError "file:line: ...", also for binary meshes, hanging nodes,
/// polygons and polyhedra.
MeshOfFile read_fluent(const std::string& path);

}  // namespace quadloop::io
