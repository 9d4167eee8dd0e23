#pragma once

#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop {

/// Writes a mesh file of Fluent of two or three dimensions, ASCII, into the set; the bytes are the same on
/// any number of ranks. Nodes keep their numbers, and so do cells where there is one block; those of several
/// blocks are in the file block by block, a zone each. A zone of faces for each boundary, of its name and
/// condition
/// ("none" is a wall); a plane edge has its first cell to its left, a face of a 3D mesh looks into its first
/// cell. *Collective.* Throws OutputError on all ranks.
void write_fluent(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Names of zones: letters, digits and "_-.+".
std::vector<std::string> fluent_zone_names(const std::vector<std::string>& names);

/// Whether a file begins as those of Fluent do.
bool is_fluent(const std::string& path);

/// Reads a mesh file of Fluent of two or three dimensions, ASCII, on the calling rank alone: triangles and
/// quadrilaterals, or tetrahedra, pyramids, prisms and hexahedra. Zones of cells become blocks, zones of
/// faces boundaries with their conditions; faces inside a block are left out. A plane cell begins with any of
/// its nodes. A plane mesh is cleaned up by plane_mesh(). Throws InputError "file:line: ..." also for meshes
/// in binary, with hanging nodes, polygons or polyhedra.
MeshOfFile read_fluent(const std::string& path);

}  // namespace quadloop
