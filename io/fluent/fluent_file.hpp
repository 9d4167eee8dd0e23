#pragma once

#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/solid/solid_stream.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Writes the mesh as a 2D mesh file of Fluent, ASCII, into the set; the bytes are the same on any number of
/// ranks. Nodes and cells keep their numbers, triangles before quads; a zone of faces for each boundary with
/// edges, of its name and condition ("none" is a wall); each face with the cell to its left first.
/// *Collective.* Throws OutputError on all ranks.
void write_fluent(OutputSet& outputs, const Mesh& mesh, const std::string& path);

/// The same for a mesh that the set's only rank holds: each block is a zone of cells, numbered block by
/// block.
void write_fluent(OutputSet& outputs, const LoadedMesh& whole, const std::string& path);

/// Names of zones: letters, digits and "_-.+".
std::vector<std::string> fluent_zone_names(const std::vector<std::string>& names);

/// Whether a file begins as those of Fluent do.
bool is_fluent(const std::string& path);

/// Writes a 3D mesh file of Fluent, ASCII, into the set; the bytes are the same on any number of ranks. Nodes
/// keep their numbers, and so do cells where there is one block; those of several stand block by block, a
/// zone each. A zone of faces for each patch, of its name and condition ("none" is a wall); each face looks
/// into its first cell. *Collective.* Throws OutputError on all ranks.
void write_fluent_solid(OutputSet& outputs, const SolidStream& mesh, const std::string& path);

/// Reads a mesh file of Fluent of two or three dimensions, ASCII, on the calling rank alone: triangles and
/// quadrilaterals, or tetrahedra, pyramids, prisms and hexahedra. Zones of cells become blocks, zones of
/// faces boundaries with their conditions; faces inside a block are left out. A plane cell begins with any of
/// its nodes. A plane mesh is cleaned up by plane_mesh(). Throws InputError "file:line: ..." also for meshes
/// in binary, with hanging nodes, polygons or polyhedra.
MeshOfFile read_fluent(const std::string& path);

}  // namespace quadloop
