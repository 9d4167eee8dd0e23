#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "io/stream/mesh_stream.hpp"

namespace quadloop::io {

/// Whether numbers of nodes and elements have 64 bits only in files that need it, or always.
enum class CgnsSizes { as_needed, always_64_bits };

/// Writes a 2D or 3D mesh as CGNS (HDF5) into the set: one zone "domain" with a section for each kind of
/// cells and, for each boundary, a BAR_2 section, or one of quads and one of triangles, with BC and family.
/// Boundary names are truncated to CGNS limits; the full name is stored as a descriptor. Nodal and cell
/// values are stored as one FlowSolution_t each. The library is serial: rank 0 creates the file with space
/// for all arrays, which are then written by all ranks. Throws OutputError on all ranks. *Collective.*
void write_cgns(OutputSet& outputs, const MeshStream& mesh, const std::string& path,
                CgnsSizes sizes = CgnsSizes::as_needed);

/// Reads the first base of a CGNS file: unstructured zones with sections of TRI_3, QUAD_4, BAR_2 and MIXED,
/// in 3D also TETRA_4, PYRA_5, PENTA_6 and HEXA_8. In 2D each zone is a block, and coincident nodes of two
/// zones are merged. A plane mesh of one zone is read by ranges: the root reads what is not in large arrays,
/// with all boundary edges, and each rank its share of the arrays. The root reads the whole mesh if there are
/// several zones or MIXED sections, if an array is not one piece of the file (chunked, compressed, in another
/// file), and if the file is not HDF5 or is damaged. A 3D mesh remains on the root. Throws InputError on all
/// ranks on anything else. *Collective.*
MeshOfFile read_cgns(const Communicator& comm, const std::string& path);

}  // namespace quadloop::io
