#pragma once

#include <optional>
#include <string>
#include <vector>

namespace quadloop::io {

/// The kind of a file by its first bytes, independent of its name.
struct FileKind {
  std::string what;                   ///< "a VTK file in the legacy format", for a message
  std::vector<std::string> suffixes;  ///< suffixes under which it is read; empty if there is no reader
  std::string cure;                   ///< remedy if there is none
};

/// Empty if the first bytes are of no known kind, or the path is not a regular file.
std::optional<FileKind> kind_of_file(const std::string& path);

}  // namespace quadloop::io
