#pragma once

#include <cstddef>
#include <string>

namespace quadloop::flow {

/// Returns the last line of a file with a letter or a digit in it, truncated to `length` bytes. For a Python
/// traceback this is the error itself; separator lines, as printed by mpirun, are skipped. Only the end of
/// the file is read. Carriage returns end a line too (for progress displays); other control characters become
/// '?'. Empty if there is no such line, or the file cannot be read.
std::string last_line(const std::string& path, std::size_t length = 200);

/// Returns the first error that OpenFOAM or SU2 reports at the end of a log, on one line, truncated to
/// `length` bytes: "FOAM FATAL IO ERROR: ..." up to the location in OpenFOAM's source, with several ranks
/// that of the first one; or the text between SU2's lines "Error in" and "Error Exit". Empty if there is
/// none, or the file cannot be read.
std::string reported_error(const std::string& path, std::size_t length = 300);

/// Returns the last 64 KiB of a file; empty if it cannot be read.
std::string end_of_file(const std::string& path);

}  // namespace quadloop::flow
