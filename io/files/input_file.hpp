#pragma once

#include <string>

namespace quadloop {

/// Throws InputError where no file can be read at the path: nothing there, a name too long, a folder, a
/// device (which may have no end), a pipe.
void require_input_file(const std::string& path);

/// All bytes of a text file that a user gave; also of a pipe, where that is allowed, as long as it ends in
/// time. Throws InputError.
std::string read_input(const std::string& path);

/// Whether read_input() takes pipes; at first it does not. Only where one rank reads: what it takes from a
/// pipe is gone for the others.
void allow_piped_input(bool allowed);

}  // namespace quadloop
