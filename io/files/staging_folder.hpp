#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/files/folder_lock.hpp"
#include "io/files/interruption.hpp"

namespace quadloop::io {

/// Identifies a folder independently of its path: device and inode.
using FolderId = std::pair<std::uint64_t, std::uint64_t>;

/// A folder next to the outputs where they are written until all are complete. It has a unique name, is
/// private, and is locked as long as its owner runs, so that remains of killed runs can be distinguished. On
/// one rank.
class StagingFolder {
 public:
  /// Creates it in `parent`, after removing the remains of killed runs of this machine there. Throws
  /// OutputError that names `shown`.
  StagingFolder(const std::string& parent, const std::string& shown);
  /// Removes it with its contents.
  ~StagingFolder();
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;

  /// Creates an empty file for an output. Throws OutputError that names `shown`.
  std::string new_file(const std::string& shown);
  const std::string& parent() const { return parent_; }

 private:
  void make(const std::string& shown);

  std::string parent_;
  std::optional<Temporary> folder_;
  std::vector<Temporary> files_;
  std::optional<FolderLock> lock_;
};

}  // namespace quadloop::io
