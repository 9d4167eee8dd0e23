#pragma once

#include <cstddef>
#include <string>

namespace quadloop {

/// What the first error of OpenFOAM's in the end of a log says, on one line: "FOAM FATAL IO ERROR: ..." up to
/// the place in OpenFOAM's source, cut to `length` bytes; of several ranks the first one's. Empty where there
/// is none, or the file cannot be read.
std::string foam_error(const std::string& path, std::size_t length = 300);

}  // namespace quadloop
