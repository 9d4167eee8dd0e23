#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop {

/// Writes a mesh of two or three dimensions as CGNS (HDF5) into the set: one zone "domain" with a section for
/// each kind of cells, and for each boundary a BAR_2 section, or one of quads and one of triangles, with BC
/// and family. A boundary's name is cut to what CGNS can hold; the full one is kept beside it. The solution
/// becomes a FlowSolution_t at the vertices, and one in the cells. The library is serial, so all passes
/// through rank 0 in bounded pieces; a mesh with more entries than its sizes can count is refused.
/// *Collective.* Throws OutputError on all ranks.
void write_cgns(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Reads the first base of a CGNS file on the calling rank alone: unstructured zones with sections of TRI_3,
/// QUAD_4, BAR_2 and MIXED, of three dimensions also TETRA_4, PYRA_5, PENTA_6 and HEXA_8. Of two dimensions
/// each zone is a block, and nodes at the same place in two zones are made one; of three dimensions there is
/// one zone. Throws InputError on anything else.
MeshOfFile read_cgns(const std::string& path);

}  // namespace quadloop
