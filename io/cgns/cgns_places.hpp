#pragma once

// For quadloop-reader (io/reader), a separate process.
#include <string>

#include "io/cgns/cgns_contents.hpp"

namespace quadloop::io {

/// Finds with HDF5 where the arrays are in a CGNS file. Returns false if one of them is not one piece of the
/// file with its count of numbers: it is chunked or compressed, in another file, of other numbers, or not
/// written at all; or if the file is not HDF5.
bool find_places(const std::string& path, CgnsContents& contents);

}  // namespace quadloop::io
