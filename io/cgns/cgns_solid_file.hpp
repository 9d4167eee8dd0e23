#pragma once

#include <string>
#include <vector>

#include "io/cgns/cgns_handle.hpp"
#include "io/model/file_mesh.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

/// Reads the one zone of a 3D CGNS file that is open: sections of TETRA_4, PYRA_5, PENTA_6, HEXA_8, TRI_3 and
/// QUAD_4. Throws InputError.
FileMesh read_cgns_solid(const CgnsFile<InputError>& file, int zones);

}  // namespace quadloop
