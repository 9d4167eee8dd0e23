#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// Version of the MSH text that is written.
enum class MshVersion { msh_2_2, msh_4_1 };

/// Writes a mesh as Gmsh's MSH text into the set; the bytes are the same on any number of ranks. Each
/// boundary is a physical curve or surface with its name, each block a physical surface or volume, "domain"
/// for a single one without a name. Throws OutputError on all ranks. *Collective.*
void write_msh(OutputSet& outputs, const MeshStream& mesh, const std::string& path,
               MshVersion version = MshVersion::msh_2_2);

/// Returns the name of a boundary's physical group: double quotes become single quotes.
std::string msh_group_name(std::string boundary);

/// Reads a Gmsh mesh, MSH 2.2 or 4.1 text, on the calling rank only. It is 3D if it has 3D elements; else its
/// nodes must be in a plane z = constant. Nodes without elements are omitted. The physical groups of the
/// mesh's dimension become blocks, those of one dimension less boundaries (for an element in several groups
/// the one with the fewest members); without a physical group the block is "domain" and the boundary
/// "boundary_<tag of the curve or surface>"; a group without a name is "physical_<tag>". A plane mesh is
/// cleaned up by plane_mesh(). Throws InputError "file:line: ..." on anything else; geometric errors,
/// including inverted cells, are left to validate() and check_mesh3d().
MeshOfFile read_msh(const std::string& path);

}  // namespace quadloop::io
