#pragma once

#include <string>

#include "io/files/output_file.hpp"
#include "io/model/mesh_of_file.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Writes the mesh as CGNS (HDF5) into the set: one zone "domain" with sections TRI_3 and QUAD_4 and one
/// BAR_2 section, BC and family for each boundary that has edges. A boundary's name is cut to what CGNS can
/// hold; the full one is kept beside it. `solution`, where given, becomes a FlowSolution_t at the vertices,
/// and one in the cells. The library is serial, so all passes through rank 0 in bounded pieces; a mesh with
/// more entries than its sizes can count is refused. *Collective.* Throws OutputError on all ranks.
void write_cgns(OutputSet& outputs, const Mesh& mesh, const std::string& path,
                const Field* solution = nullptr);

/// The same as an output of its own, in place when the function returns. *Collective.*
void write_cgns(const Communicator& comm, const Mesh& mesh, const std::string& path,
                const Field* solution = nullptr);

/// Reads the first base of a CGNS file on the calling rank alone: of two dimensions unstructured zones of
/// TRI_3, QUAD_4, MIXED and BAR_2 sections, each zone a block, nodes at the same place in two zones made one;
/// of three dimensions one zone (read_cgns_solid()). Throws InputError on anything else.
MeshOfFile read_cgns(const std::string& path);

}  // namespace quadloop
