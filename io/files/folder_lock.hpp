#pragma once

#include <optional>
#include <string>
#include <utility>

namespace quadloop {

/// Keeps other runs from giving files of one folder their names, for a moment. The lock is on the file
/// `.quadloop.lock` there, which goes with it; it ends with its process, however that ends. On a file system
/// without locks it is none, and says nothing. On one rank.
class FolderLock {
 public:
  /// Nothing where another run holds it. To be called under SignalsWait, which must last as long as the lock.
  static std::optional<FolderLock> attempt(const std::string& folder);

  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept;
  FolderLock& operator=(FolderLock&&) = delete;

 private:
  FolderLock(std::string file, int descriptor) : file_{std::move(file)}, descriptor_{descriptor} {}

  std::string file_;
  int descriptor_ = -1;
};

}  // namespace quadloop
