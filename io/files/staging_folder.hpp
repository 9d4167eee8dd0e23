#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/files/folder_lock.hpp"
#include "io/files/interruption.hpp"

namespace quadloop {

/// What one folder is known by, whatever path leads to it: device and inode.
using FolderId = std::pair<std::uint64_t, std::uint64_t>;

/// A folder beside the outputs where they are written until all are whole. It has a name that no other run
/// has, nobody else may enter it, and it is locked as long as its owner lives, so that what a killed run left
/// is told from what a living one needs. On one rank.
class StagingFolder {
 public:
  /// In `parent`, after removing there what killed runs of this machine left. Throws OutputError that names
  /// `shown`.
  StagingFolder(const std::string& parent, const std::string& shown);
  /// Removes it with all that is still in it.
  ~StagingFolder();
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder& operator=(const StagingFolder&) = delete;

  /// Makes an empty file for an output. Throws OutputError that names `shown`.
  std::string new_file(const std::string& shown);
  const std::string& parent() const { return parent_; }

 private:
  void make(const std::string& shown);

  std::string parent_;
  std::optional<Temporary> folder_;
  std::vector<Temporary> files_;
  std::optional<FolderLock> lock_;
};

}  // namespace quadloop
