#pragma once

// For quadloop-reader (io/reader), in a process of its own.
#include <string>

#include "io/model/file_mesh.hpp"

namespace quadloop {

/// Reads the first base of a CGNS file as read_cgns() says, in this process, which libcgns may end where the
/// file is damaged. Edges between two zones of a plane mesh are there once for each zone. Throws InputError.
FileMesh read_cgns_by_library(const std::string& path);

}  // namespace quadloop
