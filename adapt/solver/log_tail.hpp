#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace quadloop {

/// The last lines of a file that are not blank, oldest first: at most `lines` of them, each cut to `length` bytes. Only the file's end is read,
/// whatever its size. Carriage returns end a line as well (progress is shown so); other control characters become '?'. Nothing where the file
/// cannot be read.
std::vector<std::string> last_lines(const std::string& path, std::size_t lines = 5, std::size_t length = 200);

}  // namespace quadloop
