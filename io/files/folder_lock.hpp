#pragma once

#include <optional>
#include <string>
#include <utility>

namespace quadloop {

/// A lock on a folder, which ends with its process, however that ends. On a file system that has no locks on
/// folders (NFS) it is none, and says nothing. On one rank.
class FolderLock {
 public:
  /// Nothing where another owner holds it.
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

}  // namespace quadloop
