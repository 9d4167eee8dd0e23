#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/solid/solid_stream.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Which text of Gmsh's is written.
enum class MshVersion { msh_2_2, msh_4_1 };

/// Writes the mesh as Gmsh's MSH text into the set; the bytes are the same on any number of ranks. Each
/// boundary with edges is a physical curve of its name, the cells are the physical surface "domain". A double
/// quote in a name becomes a single one. *Collective.* Throws OutputError on all ranks.
void write_msh(OutputSet& outputs, const Mesh& mesh, const std::string& path,
               MshVersion version = MshVersion::msh_2_2);

/// The same as an output of its own, in place when the function returns. *Collective.*
void write_msh(const Communicator& comm, const Mesh& mesh, const std::string& path);

/// Writes a mesh that the set's only rank holds whole; its blocks are the physical surfaces. Throws
/// OutputError.
void write_msh(OutputSet& outputs, const LoadedMesh& whole, const std::string& path,
               MshVersion version = MshVersion::msh_2_2);

/// The name of the physical curve for a boundary of this name.
std::string msh_group_name(std::string boundary);

/// Writes a 3D mesh as Gmsh's MSH text; the bytes are the same on any number of ranks. Patches are physical
/// surfaces, the cells the physical volume "domain", or one for each block, block by block; names as
/// write_msh() has them. *Collective.* Throws OutputError on all ranks.
void write_msh_solid(OutputSet& outputs, const SolidStream& mesh, const std::string& path,
                     MshVersion version = MshVersion::msh_2_2);

/// Reads a mesh of Gmsh, MSH 2.2 or 4.1 text, on the calling rank alone. It is 3D where it has 3D elements;
/// else its nodes lie in a plane z = constant. Nodes of no element are left out. The physical groups of the
/// mesh's own dimension become blocks, those of one dimension less boundaries (of an element in several
/// groups the one with the fewest members); without a physical group the block is "domain" and the boundary
/// "boundary_<tag of the curve or surface>", where a group has no name "physical_<tag>". A plane mesh is
/// cleaned up by plane_mesh(). Throws InputError "file:line: ..." on anything that is not such a mesh;
/// geometric faults, inverted cells too, are left to validate() and check_solid().
MeshOfFile read_msh(const std::string& path);

}  // namespace quadloop
