#pragma once

#include <string>
#include <vector>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// Writes a 2D or 3D mesh as SU2 text into the set; the bytes are the same on any number of ranks. Each
/// boundary becomes a marker with its name in su2_marker_names(); prisms have the node order of a VTK wedge.
/// SU2's angle of attack is in the x-z plane, so a mesh should be extruded along y. Throws OutputError on all
/// ranks. *Collective.*
void write_su2(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Returns distinct marker names for these boundaries: SU2 accepts no blanks and few special characters, so
/// characters other than letters, digits and "_-.+" become "_", and duplicates get a number. Deterministic.
std::vector<std::string> su2_marker_names(const std::vector<std::string>& boundaries);

/// Reads a 2D or 3D SU2 mesh on the calling rank only: keys may be in any order; those that are not part of
/// the mesh are skipped with their rows, and so are markers SEND_RECEIVE. Each marker becomes a boundary,
/// those of the same name are merged; a plane file without markers gets the boundary "boundary". Zones become
/// blocks "zone_1", "zone_2" ..., each with its own nodes and markers. A plane mesh is cleaned up by
/// plane_mesh(). Throws InputError "file:line: ..." on anything else; geometric errors, including inverted
/// cells, are left to validate() and check_mesh3d().
MeshOfFile read_su2(const std::string& path);

}  // namespace quadloop::io
