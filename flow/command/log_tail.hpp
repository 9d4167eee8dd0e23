#pragma once

#include <cstddef>
#include <string>

namespace quadloop {

/// The last line of a file that says something, with a letter or a digit in it, cut to `length` bytes. Of a
/// Python traceback that is the error itself; rulers as mpirun prints are passed over. Only the file's end is
/// read, whatever its size. Carriage returns end a line as well (progress is shown so); other control
/// characters become '?'. Empty where there is no such line, or the file cannot be read.
std::string last_line(const std::string& path, std::size_t length = 200);

/// What the first error of OpenFOAM's in the end of a log says, on one line: "FOAM FATAL IO ERROR: ..." up to
/// the place in OpenFOAM's source, cut to `length` bytes; of several ranks the first one's. Empty where there
/// is none, or the file cannot be read.
std::string foam_error(const std::string& path, std::size_t length = 300);

}  // namespace quadloop
