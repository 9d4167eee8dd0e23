#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop {

/// Which text of Gmsh's is written.
enum class MshVersion { msh_2_2, msh_4_1 };

/// Writes a mesh as Gmsh's MSH text into the set; the bytes are the same on any number of ranks. Each
/// boundary is a physical curve or surface of its name, each block a physical surface or volume, "domain"
/// where there is one without a name. *Collective.* Throws OutputError on all ranks.
void write_msh(OutputSet& outputs, const MeshStream& mesh, const std::string& path,
               MshVersion version = MshVersion::msh_2_2);

/// The name of the physical group for a boundary of this name: a double quote becomes a single one.
std::string msh_group_name(std::string boundary);

/// Reads a mesh of Gmsh, MSH 2.2 or 4.1 text, on the calling rank alone. It is 3D where it has 3D elements;
/// else its nodes lie in a plane z = constant. Nodes of no element are left out. The physical groups of the
/// mesh's own dimension become blocks, those of one dimension less boundaries (of an element in several
/// groups the one with the fewest members); without a physical group the block is "domain" and the boundary
/// "boundary_<tag of the curve or surface>", where a group has no name "physical_<tag>". A plane mesh is
/// cleaned up by plane_mesh(). Throws InputError "file:line: ..." on anything that is not such a mesh;
/// geometric faults, inverted cells too, are left to validate() and check_solid().
MeshOfFile read_msh(const std::string& path);

}  // namespace quadloop
