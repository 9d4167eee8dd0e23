#pragma once

#include <string>

namespace quadloop {

/// Throws the OutputError of an output that cannot be written for `reason`, an errno: what it is, and what to
/// do.
[[noreturn]] void refuse_output(const std::string& path, int reason);

/// The file that writing to `path` makes or replaces: `path` itself, or where it is a link, what it leads to.
/// Throws OutputError where that cannot become a file: its folder is missing or may not be written to, its
/// name is too long, or a folder, a pipe or a device stands there.
std::string output_target(const std::string& path);

/// Refuses what output_target() refuses: found out before an hour of work goes into the output.
void require_possible_output(const std::string& path);

/// The same for an output that is a folder: one there, or none, and leave to write to it or to make it.
void require_possible_folder(const std::string& path);

/// The folder of a file; "." where the path names none.
std::string folder_of(const std::string& path);

/// What was written to a file or folder outlives a loss of power only then; a full disk may tell only now.
/// Throws OutputError that names `shown`.
void bring_to_disk(const std::string& path, const std::string& shown);

}  // namespace quadloop
