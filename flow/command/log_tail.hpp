#pragma once

#include <cstddef>
#include <string>

namespace quadloop {

/// The last 64 KiB; empty where the file cannot be read.
std::string end_of_file(const std::string& path);

/// A line without blanks at its ends, cut to `length` bytes between characters, tabs as blanks and other
/// control characters as '?'.
std::string fit_for_message(std::string line, std::size_t length);

/// The last line of a file that says something, with a letter or a digit in it, cut to `length` bytes. Of a
/// Python traceback that is the error itself; rulers as mpirun prints are passed over. Only the file's end is
/// read, whatever its size. Carriage returns end a line as well (progress is shown so); other control
/// characters become '?'. Empty where there is no such line, or the file cannot be read.
std::string last_line(const std::string& path, std::size_t length = 200);

}  // namespace quadloop
