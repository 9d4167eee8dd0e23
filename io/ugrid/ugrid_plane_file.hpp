#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop {

/// Writes the mesh as a 2D UGRID file in text, the form that AFLR2 takes (SimCenter, Mississippi State
/// University: UG_IO, 2D grid file types): seven counts, the last four 0; x, y and z = 0 of the nodes; the
/// nodes of triangles and quads; an identifier for each, 1; the number of boundary edges; the two nodes of
/// each and the number of its boundary. Beside it a .ugrid.mapbc with the number, condition and name of each
/// boundary. The bytes are the same on any number of ranks. *Collective.* Throws OutputError on all ranks.
void write_ugrid_plane(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Reads such a file on the calling rank alone; z is ignored, edges may be missing; boundaries without a
/// .mapbc are "boundary_1" and so on. What follows the edges is passed over. Throws InputError "file:line:
/// ...".
MeshOfFile read_ugrid_plane(const std::string& path);

}  // namespace quadloop
