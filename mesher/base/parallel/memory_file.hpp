#pragma once

#include <sys/types.h>

#include <cstddef>
#include <optional>
#include <span>

#include "mesher/base/parallel/shared_array.hpp"

namespace quadloop {

/// Memory as a file without a name, which other processes of the machine can map while this object exists.
/// What is mapped remains after that, also if the process ends. Not collective.
class MemoryFile {
 public:
  /// Where another process finds the file, and which one it must be. Trivially copyable.
  struct Place {
    pid_t process = 0;
    int descriptor = -1;
    dev_t device = 0;
    ino_t inode = 0;
    std::size_t size = 0;  ///< in bytes; 0: there is no file
  };

  /// Returns a file of `size` bytes, at least 1; none if the system permits no such file or has no memory for
  /// it.
  static std::optional<MemoryFile> of_size(std::size_t size);
  MemoryFile(MemoryFile&& other) noexcept;
  MemoryFile& operator=(MemoryFile&& other) noexcept;
  ~MemoryFile();

  const Place& place() const { return place_; }
  /// To be written before another process maps the file.
  std::span<std::byte> bytes() const { return {at_, place_.size}; }
  /// Returns the bytes as an array; they cannot be written any more.
  SharedArray<std::byte> finished() &&;

 private:
  MemoryFile() = default;
  bool open(std::size_t size);

  Place place_;
  std::byte* at_ = nullptr;
};

/// Maps a file of this or another process for reading; empty if that is impossible.
SharedArray<std::byte> mapped(const MemoryFile::Place& place);

}  // namespace quadloop
