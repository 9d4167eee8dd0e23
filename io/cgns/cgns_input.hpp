#pragma once

// For quadloop-reader (io/reader), a separate process.
#include <string>

#include "io/cgns/cgns_contents.hpp"

namespace quadloop::io {

/// Reads the first base of a CGNS file as read_cgns() does, in this process, which libcgns may crash if the
/// file is damaged. Of a plane mesh of one zone, if allowed, only what is not in arrays that any rank can
/// read. Edges between two zones of a plane mesh occur once for each zone. Throws InputError.
CgnsContents read_cgns_by_library(const std::string& path, bool may_be_by_ranges);

}  // namespace quadloop::io
