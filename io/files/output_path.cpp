#include "io/files/output_path.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>

#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

constexpr int most_links = 40;  // the kernel's own limit

std::string cure_of(int reason) {
  switch (reason) {
    case ENOENT:
    case ENOTDIR: return "; create its folder first or name another output";
    case EACCES:
    case EPERM:
    case EROFS: return "; name an output in a folder that you may write to";
    case ENOSPC:
    case EDQUOT: return "; free some space or name an output elsewhere";
    case EFBIG: return "; raise the limit of a file's size (ulimit -f) or name an output elsewhere";
    case ENAMETOOLONG: return "; give a shorter name";
    case EISDIR: return "; choose another name";
    default: return "";
  }
}

[[noreturn]] void refuse_kind(const std::string& path, const std::string& kind) {
  throw OutputError(path + ": is " + kind + ", not a file; choose another name");
}

/// Whether it is a stream of the process, which a rename would not affect even if it is a file.
bool is_stream(const std::string& path) {
  const std::string normal = std::filesystem::path(path).lexically_normal().string();
  return normal == "/dev/stdout" || normal == "/dev/stderr" || normal == "/dev/stdin" ||
         normal.starts_with("/dev/fd/") || normal.starts_with("/proc/");
}

/// Requires that the path can be replaced by a file, or does not exist.
void require_file_or_nothing(const std::string& path) {
  if (is_stream(path)) refuse_kind(path, "a stream of the process");
  struct stat found = {};
  if (::stat(path.c_str(), &found) != 0) {
    if (errno != ENOENT && errno != ENOTDIR) refuse_output(path, errno);
    return;
  }
  if (S_ISDIR(found.st_mode)) refuse_kind(path, "a folder");
  if (S_ISFIFO(found.st_mode)) refuse_kind(path, "a pipe");
  if (!S_ISREG(found.st_mode)) refuse_kind(path, "a device");
}

void require_folder(const std::string& folder, const std::string& shown) {
  struct stat found = {};
  const bool there = ::stat(folder.c_str(), &found) == 0;
  if (!there && errno != ENOENT && errno != ENOTDIR) refuse_output(shown, errno);
  if (!there || !S_ISDIR(found.st_mode))
    throw OutputError(shown + ": cannot be written: the folder '" + folder +
                      "' does not exist; create it first");
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw OutputError(shown + ": cannot be written: you may not write to the folder '" + folder + "'");
}

/// Follows links, also to a file that does not exist yet, as a shell does.
std::string without_links(const std::string& path) {
  std::filesystem::path at = path;
  for (int links = 0; links < most_links; ++links) {
    std::error_code no_link;
    const std::filesystem::path next = std::filesystem::read_symlink(at, no_link);
    if (no_link) return at.string();
    at = at.parent_path() / next;
  }
  refuse_output(path, ELOOP);
}

}  // namespace

void refuse_output(const std::string& path, int reason) {
  throw OutputError(path + ": cannot be written: " + std::strerror(reason) + cure_of(reason));
}

std::string folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

std::string output_target(const std::string& path) {
  require_file_or_nothing(path);
  const std::string target = without_links(path);
  require_folder(folder_of(target), path);
  return target;
}

void require_possible_output(const std::string& path) { output_target(path); }

void require_possible_folder(const std::string& path) {
  std::error_code unknown;
  const bool there = std::filesystem::exists(path, unknown);
  if (there && !std::filesystem::is_directory(path, unknown))
    throw OutputError(path + ": is no folder; choose another name");
  require_folder(there ? path : folder_of(path), path);
}

void bring_to_disk(const std::string& path, const std::string& shown) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (descriptor < 0 && errno == EACCES) return;  // a file that only another user may read
  if (descriptor < 0) refuse_output(shown, errno);
  const int reason = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  // not supported by the file system
  const bool unknown_here = reason == EINVAL || reason == EBADF || reason == ENOSYS || reason == ENOTSUP;
  if (reason != 0 && !unknown_here) refuse_output(shown, reason);
}

}  // namespace quadloop::io
