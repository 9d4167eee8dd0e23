#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// Writes a 2D or 3D mesh as CGNS (HDF5) into the set: one zone "domain" with a section for each kind of
/// cells and, for each boundary, a BAR_2 section, or one of quads and one of triangles, with BC and family.
/// Boundary names are truncated to CGNS limits; the full name is stored as a descriptor. Nodal and cell
/// values are stored as one FlowSolution_t each. The library is serial, so all data are streamed through rank
/// 0 in bounded pieces. Throws OutputError on all ranks, also for a mesh with more entries than CGNS sizes
/// can represent. *Collective.*
void write_cgns(OutputSet& outputs, const MeshStream& mesh, const std::string& path);

/// Reads the first base of a CGNS file on the calling rank only: unstructured zones with sections of TRI_3,
/// QUAD_4, BAR_2 and MIXED, in 3D also TETRA_4, PYRA_5, PENTA_6 and HEXA_8. In 2D each zone is a block, and
/// coincident nodes of two zones are merged; in 3D there must be one zone. Throws InputError on anything
/// else.
MeshOfFile read_cgns(const std::string& path);

}  // namespace quadloop::io
