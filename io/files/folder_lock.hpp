#pragma once

#include <optional>
#include <string>
#include <utility>

namespace quadloop::io {

/// A lock on a folder. It ends with the process, however that ends. On a file system without locks on folders
/// (NFS) it silently has no effect. On one rank.
class FolderLock {
 public:
  /// Empty if another owner holds the lock.
  static std::optional<FolderLock> attempt(const std::string& folder);

  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept : descriptor_{std::exchange(other.descriptor_, -1)} {}
  FolderLock& operator=(FolderLock&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
  }

  bool is_held() const { return descriptor_ >= 0; }

 private:
  explicit FolderLock(int descriptor) : descriptor_{descriptor} {}

  int descriptor_ = -1;
};

}  // namespace quadloop::io
