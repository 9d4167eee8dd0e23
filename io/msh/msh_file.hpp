#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/loaded/loaded_mesh.hpp"
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

/// Reads a 2D mesh of Gmsh, MSH 2.2 or 4.1 text, on the calling rank alone. Nodes lie in a plane z =
/// constant; those of no cell are left out. Physical surfaces become blocks, physical curves boundaries (of
/// an element in several groups the one with the fewest curves or surfaces); without a physical group the
/// block is "domain" and the boundary "boundary_<tag of the curve>", where a group has no name
/// "physical_<tag>". Lines inside a block are left out; a file without other lines gets the boundary
/// "boundary". Cells are turned counter-clockwise piece by piece (orient_cells), edges with their cell to the
/// left. Throws InputError "file:line: ..." on anything that is not such a mesh; geometric faults, inverted
/// cells too, are left to validate().
LoadedMesh read_msh(const std::string& path);

}  // namespace quadloop
