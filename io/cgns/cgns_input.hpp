#pragma once

// For quadloop-reader (io/reader), a separate process.
#include <string>

#include "io/model/file_mesh.hpp"

namespace quadloop::io {

/// Reads the first base of a CGNS file as read_cgns() does, in this process, which libcgns may crash if the
/// file is damaged. Edges between two zones of a plane mesh occur once for each zone. Throws InputError.
FileMesh read_cgns_by_library(const std::string& path);

}  // namespace quadloop::io
