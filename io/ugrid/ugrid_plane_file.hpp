#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// Writes the mesh as a 2D UGRID text file in the format of AFLR2 (SimCenter, Mississippi State University:
/// UG_IO, 2D grid file types): seven counts, the last four 0; x, y and z = 0 of the nodes; the nodes of
/// triangles and quads; for each the number of its block, from 1; the number of boundary edges; two nodes and
/// the boundary number of each. A .ugrid.mapbc file contains number, condition and name of each boundary. The
/// bytes are the same on any number of ranks. Throws OutputError on all ranks. *Collective.*
void write_ugrid_plane(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Reads such a file on the calling rank only; z is ignored, edges may be missing; boundaries without a
/// .mapbc are "boundary_1" and so on, and blocks are "block_1" and so on by the identifiers of the cells.
/// Data after the edges are ignored. Throws InputError "file:line: ...".
MeshOfFile read_ugrid_plane(const std::string& path);

}  // namespace quadloop::io
