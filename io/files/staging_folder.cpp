#include "io/files/staging_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <filesystem>
#include <system_error>

#include "io/files/output_path.hpp"

namespace quadloop::io {

namespace {

namespace fs = std::filesystem;

constexpr mode_t mine_alone = 0700;
constexpr mode_t readable_by_all = 0666;  // minus the user's umask
constexpr const char* ending = ".part";

/// Prefix of the names of this machine's folders: only its own kernel reliably knows whether a lock on a
/// folder is still held.
std::string beginning() {
  std::array<char, 65> host = {};
  if (::gethostname(host.data(), host.size() - 1) != 0) host = {};
  return fmt::format(".quadloop-{}-", host.data());
}

std::string random_letters() {
  std::uint64_t number = 0;
  if (::getrandom(&number, sizeof number, 0) != static_cast<ssize_t>(sizeof number)) number = ::getpid();
  return fmt::format("{:016x}", number);
}

/// Removes the folder of a killed run; that of a running one is locked.
void remove_if_forsaken(const fs::path& folder) {
  std::error_code ignored;
  const std::optional<FolderLock> lock = FolderLock::attempt(folder);
  if (lock && lock->is_held()) fs::remove_all(folder, ignored);
}

void remove_forsaken(const std::string& parent) {
  std::error_code ignored;
  const std::string begin = beginning();
  for (fs::directory_iterator entry(parent, ignored), end; !ignored && entry != end;
       entry.increment(ignored)) {
    const std::string name = entry->path().filename();
    if (name.starts_with(begin) && name.ends_with(ending)) remove_if_forsaken(entry->path());
  }
}

}  // namespace

StagingFolder::StagingFolder(const std::string& parent, const std::string& shown) : parent_{parent} {
  remove_forsaken(parent);
  std::error_code ignored;
  // Another run may remove the folder as abandoned between creation and locking. Without locks the folder is
  // used anyway.
  do {
    make(shown);
    lock_ = FolderLock::attempt(folder_->path());
  } while (!lock_ || !fs::is_directory(folder_->path(), ignored));
}

StagingFolder::~StagingFolder() {
  std::error_code ignored;
  fs::remove_all(folder_->path(), ignored);
}

void StagingFolder::make(const std::string& shown) {
  folder_.reset();
  folder_.emplace(parent_ + "/" + beginning() + random_letters() + ending);
  if (::mkdir(folder_->path().c_str(), mine_alone) == 0) return;
  const int reason = errno;
  folder_.reset();
  refuse_output(shown, reason);
}

std::string StagingFolder::new_file(const std::string& shown) {
  files_.emplace_back(fmt::format("{}/{}", folder_->path(), files_.size()));
  const std::string path = files_.back().path();
  const int descriptor =
      ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, readable_by_all);
  if (descriptor < 0) refuse_output(shown, errno);
  if (::close(descriptor) != 0) refuse_output(shown, errno);
  return path;
}

}  // namespace quadloop::io
