#pragma once

#include <string>

namespace quadloop::io {

/// Throws OutputError for an output that cannot be written for `reason`, an errno, with a remedy.
[[noreturn]] void refuse_output(const std::string& path, int reason);

/// Returns the file that writing to `path` creates or replaces: `path` itself or, for a link, its target.
/// Throws OutputError if that cannot be a file: its folder is missing or not writable, its name is too long,
/// or it is a folder, a pipe or a device.
std::string output_target(const std::string& path);

/// Throws as output_target() does, before any work goes into the output.
void require_possible_output(const std::string& path);

/// The same for an output folder: it must exist and be writable, or be possible to create.
void require_possible_folder(const std::string& path);

/// Returns the folder of a file; "." if the path has none.
std::string folder_of(const std::string& path);

/// Flushes a file or folder to disk, so that it survives a loss of power; a full disk may be detected only
/// here. Throws OutputError that names `shown`.
void bring_to_disk(const std::string& path, const std::string& shown);

}  // namespace quadloop::io
