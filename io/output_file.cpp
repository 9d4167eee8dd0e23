#include "io/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

constexpr mode_t readable_by_all = 0666;  // less the user's umask

[[noreturn]] void refuse(const std::string& path, int reason) {
  std::string cure;
  if (reason == ENOENT || reason == ENOTDIR) cure = "; create its folder first or name another output";
  if (reason == EACCES || reason == EROFS) cure = "; name an output in a folder that you may write to";
  if (reason == ENOSPC || reason == EDQUOT) cure = "; free some space or name an output elsewhere";
  throw OutputError(path + ": cannot be written: " + std::strerror(reason) + cure);
}

int open_for_writing(const StagedFile& file, int flags) {
  const int descriptor = ::open(file.temporary.c_str(), O_WRONLY | O_CLOEXEC | flags, readable_by_all);
  if (descriptor < 0) refuse(file.path, errno);
  return descriptor;
}

void close_descriptor(const StagedFile& file, int descriptor) {
  if (::close(descriptor) != 0) refuse(file.path, errno);
}

/// A rename onto a folder fails only at the very end, so it is refused at the start.
void refuse_folder(const std::string& path) {
  struct stat found = {};
  if (::stat(path.c_str(), &found) == 0 && S_ISDIR(found.st_mode)) refuse(path, EISDIR);
}

void bring_to_disk(const StagedFile& file) {
  const int descriptor = open_for_writing(file, 0);
  const int reason = ::fsync(descriptor) == 0 ? 0 : errno;
  close_descriptor(file, descriptor);
  if (reason != 0 && reason != EINVAL) refuse(file.path, reason);  // EINVAL: a file system that knows no fsync
}

}  // namespace

OutputSet::~OutputSet() {
  if (!comm_.is_root()) return;
  for (const StagedFile& file : staged_) ::unlink(file.temporary.c_str());
}

StagedFile OutputSet::stage(const std::string& path) {
  StagedFile file{path, path + ".part"};
  comm_.together([&] {
    if (!comm_.is_root()) return;
    refuse_folder(path);
    close_descriptor(file, open_for_writing(file, O_CREAT | O_TRUNC));
    staged_.push_back(file);
  });
  return file;
}

void OutputSet::commit() {
  comm_.together([&] {
    for (const StagedFile& file : staged_) bring_to_disk(file);
    for (const StagedFile& file : staged_) {
      if (std::rename(file.temporary.c_str(), file.path.c_str()) != 0) refuse(file.path, errno);
    }
    staged_.clear();
  });
}

OutputFile::OutputFile(StagedFile staged) : staged_{std::move(staged)}, descriptor_{open_for_writing(staged_, O_APPEND)} {}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor_, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) refuse(staged_.path, errno);
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

void OutputFile::close() { close_descriptor(staged_, std::exchange(descriptor_, -1)); }

}  // namespace quadloop
