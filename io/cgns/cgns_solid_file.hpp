#pragma once

#include <string>
#include <vector>

#include "io/cgns/cgns_handle.hpp"
#include "io/files/output_file.hpp"
#include "io/model/file_mesh.hpp"
#include "io/solid/solid_stream.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

/// Writes the mesh as 3D CGNS: one zone "domain" with sections PENTA_6 and HEXA_8, and for each patch a
/// section of quads, or one of quads and one of triangles, with BC and family as write_cgns() has them, at
/// FaceCenter; the solution at the vertices and at the cells' centres. *Collective.* Throws OutputError on
/// all ranks, also where the library's sizes cannot count the mesh.
void write_cgns_solid(OutputSet& outputs, const SolidStream& mesh, const std::string& path);

/// Reads the one zone of a 3D CGNS file that is open: sections of TETRA_4, PYRA_5, PENTA_6, HEXA_8, TRI_3 and
/// QUAD_4. Throws InputError.
FileMesh read_cgns_solid(const CgnsFile<InputError>& file, int zones);

}  // namespace quadloop
