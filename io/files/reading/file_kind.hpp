#pragma once

#include <optional>
#include <string>
#include <vector>

namespace quadloop {

/// What a file is by its first bytes, whatever its name.
struct FileKind {
  std::string what;                   ///< "a VTK file in the legacy format", for a message
  std::vector<std::string> suffixes;  ///< of names under which it is read; empty where no reader takes it
  std::string cure;                   ///< what to do where none does
};

/// Nothing where the first bytes are those of no known kind, or the path is no regular file.
std::optional<FileKind> kind_of_file(const std::string& path);

}  // namespace quadloop
