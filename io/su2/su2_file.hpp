#pragma once

#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop {

/// Writes a mesh of two or three dimensions as SU2 text into the set; the bytes are the same on any number of
/// ranks. Each boundary becomes a marker, with its name as su2_marker_names() has it; prisms have the order
/// of a VTK wedge. SU2 turns the angle of attack in the x-z plane: extrude a mesh along y for it.
/// *Collective.* Throws OutputError on all ranks.
void write_su2(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// The markers' names for boundaries of these names, all different: SU2 takes no blanks and few signs, so
/// what is not a letter, a digit or one of "_-.+" becomes "_", and names that are then the same get a number.
/// The same names always give the same answer.
std::vector<std::string> su2_marker_names(const std::vector<std::string>& boundaries);

/// Reads an SU2 mesh of two or three dimensions on the calling rank alone: the keys in any order, those that
/// are no part of the mesh passed over with their rows, markers SEND_RECEIVE too. Each marker becomes a
/// boundary, those of the same name one; a plane file without markers gets the boundary "boundary". Zones
/// become blocks "zone_1", "zone_2" ..., each with its own nodes and markers. A plane mesh is cleaned up by
/// plane_mesh(). Throws InputError "file:line: ..." on anything that is not such a mesh; geometric faults,
/// inverted cells too, are left to validate() and check_solid().
MeshOfFile read_su2(const std::string& path);

}  // namespace quadloop
