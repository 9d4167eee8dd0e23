#include "io/files/folder_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

namespace quadloop {

namespace {

constexpr mode_t lockable_by_all = 0666;  // less the user's umask

/// For reading alone where the file is another user's.
int open_lock_file(const std::string& file) {
  constexpr int flags = O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
  const int descriptor = ::open(file.c_str(), O_RDWR | flags, lockable_by_all);
  return descriptor >= 0 || errno != EACCES ? descriptor
                                            : ::open(file.c_str(), O_RDONLY | flags, lockable_by_all);
}

/// The one who held the lock before has removed the file, or it is another one by now.
bool is_still_there(const std::string& file, int descriptor) {
  struct stat mine = {}, there = {};
  return ::fstat(descriptor, &mine) == 0 && ::lstat(file.c_str(), &there) == 0 &&
         mine.st_dev == there.st_dev && mine.st_ino == there.st_ino;
}

}  // namespace

std::optional<FolderLock> FolderLock::attempt(const std::string& folder) {
  const std::string file = folder + "/.quadloop.lock";
  const int descriptor = open_lock_file(file);
  if (descriptor < 0) return FolderLock("", -1);
  const bool refused = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  if (refused || !is_still_there(file, descriptor)) {
    ::close(descriptor);
    return std::nullopt;
  }
  return FolderLock(file, descriptor);
}

FolderLock::~FolderLock() {
  if (descriptor_ < 0) return;
  ::unlink(file_.c_str());
  ::close(descriptor_);
}

FolderLock::FolderLock(FolderLock&& other) noexcept
    : file_{std::move(other.file_)}, descriptor_{std::exchange(other.descriptor_, -1)} {}

}  // namespace quadloop
