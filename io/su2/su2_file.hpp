#pragma once

#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/solid/solid_stream.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Writes the mesh as SU2 text into the set; the bytes are the same on any number of ranks. Each boundary
/// with edges becomes a marker. SU2 takes no blanks and few signs in a marker's name: what is not a letter, a
/// digit or one of "_-.+" becomes "_", and names that are then the same get a number. *Collective.* Throws
/// OutputError on all ranks.
void write_su2(OutputSet& outputs, const Mesh& mesh, const std::string& path);

/// The same as an output of its own, in place when the function returns. *Collective.*
void write_su2(const Communicator& comm, const Mesh& mesh, const std::string& path);

/// The markers' names for boundaries of these names, all different; the same names always give the same
/// answer.
std::vector<std::string> su2_marker_names(const std::vector<std::string>& boundaries);

/// Writes the mesh as SU2 text of three dimensions; the bytes are the same on any number of ranks. Patches
/// become markers (su2_marker_names()); prisms have the order of a VTK wedge. SU2 turns the angle of attack
/// in the x-z plane: extrude the mesh along y for it. *Collective.* Throws OutputError on all ranks.
void write_su2_solid(OutputSet& outputs, const SolidStream& mesh, const std::string& path);

/// Reads an SU2 mesh of two or three dimensions on the calling rank alone: the keys in any order, those that
/// are no part of the mesh passed over with their rows, markers SEND_RECEIVE too. Each marker becomes a
/// boundary, those of the same name one; a plane file without markers gets the boundary "boundary". Zones
/// become blocks "zone_1", "zone_2" ..., each with its own nodes and markers. A plane mesh is cleaned up by
/// plane_mesh(). Throws InputError "file:line: ..." on anything that is not such a mesh; geometric faults,
/// inverted cells too, are left to validate() and check_solid().
MeshOfFile read_su2(const std::string& path);

}  // namespace quadloop
