#include "mesher/base/parallel/memory_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>
#include <utility>

namespace quadloop {

namespace {

/// Whether files of this process may have `size` bytes; a longer one would raise SIGXFSZ.
bool is_permitted(std::size_t size) {
  rlimit limit{};
  return ::getrlimit(RLIMIT_FSIZE, &limit) == 0 && size <= limit.rlim_cur;
}

std::byte* map(int descriptor, std::size_t size, int protection) {
  void* const at = ::mmap(nullptr, size, protection, MAP_SHARED, descriptor, 0);
  return at == MAP_FAILED ? nullptr : static_cast<std::byte*>(at);
}

SharedArray<std::byte> unmapped_at_end(std::byte* at, std::size_t size) {
  return {{at, [size](std::byte* begin) { ::munmap(begin, size); }}, size};
}

}  // namespace

std::optional<MemoryFile> MemoryFile::of_size(std::size_t size) {
  MemoryFile file;
  return file.open(size) ? std::optional(std::move(file)) : std::nullopt;
}

bool MemoryFile::open(std::size_t size) {
  place_.descriptor = ::memfd_create("quadloop", MFD_CLOEXEC);
  const auto length = static_cast<off_t>(size);
  struct stat status {};
  // With memory reserved for all of it, later accesses cannot fail.
  if (place_.descriptor < 0 || !is_permitted(size) || ::ftruncate(place_.descriptor, length) != 0 ||
      ::posix_fallocate(place_.descriptor, 0, length) != 0 || ::fstat(place_.descriptor, &status) != 0)
    return false;
  at_ = map(place_.descriptor, size, PROT_READ | PROT_WRITE);
  if (at_ == nullptr) return false;
  place_ = {::getpid(), place_.descriptor, status.st_dev, status.st_ino, size};
  return true;
}

MemoryFile::MemoryFile(MemoryFile&& other) noexcept
    : place_{std::exchange(other.place_, {})}, at_{std::exchange(other.at_, nullptr)} {}

MemoryFile& MemoryFile::operator=(MemoryFile&& other) noexcept {
  std::swap(place_, other.place_);
  std::swap(at_, other.at_);
  return *this;
}

MemoryFile::~MemoryFile() {
  if (at_ != nullptr) ::munmap(at_, place_.size);
  if (place_.descriptor >= 0) ::close(place_.descriptor);
}

SharedArray<std::byte> MemoryFile::finished() && {
  ::mprotect(at_, place_.size, PROT_READ);
  return unmapped_at_end(std::exchange(at_, nullptr), place_.size);
}

SharedArray<std::byte> mapped(const MemoryFile::Place& place) {
  // The number of a process may belong to another one here, as in another container: hence the comparison.
  const std::string path = fmt::format("/proc/{}/fd/{}", place.process, place.descriptor);
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor < 0) return {};
  struct stat status {};
  std::byte* at = nullptr;
  if (::fstat(descriptor, &status) == 0 && status.st_dev == place.device && status.st_ino == place.inode)
    at = map(descriptor, place.size, PROT_READ);
  ::close(descriptor);
  return at == nullptr ? SharedArray<std::byte>() : unmapped_at_end(at, place.size);
}

}  // namespace quadloop
