#include "io/files/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <optional>
#include <thread>
#include <utility>

#include "io/files/folder_lock.hpp"
#include "io/files/interruption.hpp"
#include "io/files/output_path.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto patience =
    std::chrono::seconds(60);  // with another run that is renaming its files, which takes milliseconds
constexpr auto between_attempts = std::chrono::milliseconds(5);

int open_for_appending(const StagedFile& file) {
  const int descriptor = ::open(file.temporary.c_str(), O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0) refuse_output(file.path, errno);
  return descriptor;
}

FolderId id_of(const std::string& folder, const std::string& shown) {
  struct stat found = {};
  if (::stat(folder.c_str(), &found) != 0) refuse_output(shown, errno);
  return {found.st_dev, found.st_ino};
}

/// Renames files one after another. If interrupted, it restores the previous files, if the file system
/// supports hard links.
class Renaming {
 public:
  Renaming() = default;
  ~Renaming() {
    for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) undo(*step);
  }
  Renaming(const Renaming&) = delete;
  Renaming& operator=(const Renaming&) = delete;

  void rename(const StagedFile& staged, const std::string& target) {
    Step step{target, staged.temporary + ".old", Before::lost};
    if (::link(target.c_str(), step.saved.c_str()) == 0)
      step.before = Before::saved;
    else if (errno == ENOENT)
      step.before = Before::nothing;
    if (std::rename(staged.temporary.c_str(), target.c_str()) != 0) refuse_output(staged.path, errno);
    steps_.push_back(std::move(step));
  }
  void keep() { steps_.clear(); }

 private:
  enum class Before { nothing, saved, lost };
  struct Step {
    std::string target, saved;
    Before before;
  };

  static void undo(const Step& step) {
    if (step.before == Before::saved) std::rename(step.saved.c_str(), step.target.c_str());
    if (step.before == Before::nothing) ::unlink(step.target.c_str());
  }

  std::vector<Step> steps_;
};

/// Locks all folders, in the same order in every run; empty if another run has one of the locks.
std::optional<std::vector<FolderLock>> lock_all(
    const std::map<FolderId, std::unique_ptr<StagingFolder>>& staging) {
  std::vector<FolderLock> locks;
  for (const auto& [id, folder] : staging) {
    std::optional<FolderLock> lock = FolderLock::attempt(folder->parent());
    if (!lock) return std::nullopt;
    locks.push_back(std::move(*lock));
  }
  return locks;
}

}  // namespace

OutputSet::~OutputSet() {
  for (const Written& file : written_) ::close(file.descriptor);
  staging_.clear();  // the staging folder may be inside an output folder
  for (const auto& folder : folders_) ::rmdir(folder->path().c_str());
}

StagingFolder& OutputSet::staging_beside(const std::string& target, const std::string& shown) {
  const std::string folder = folder_of(target);
  std::unique_ptr<StagingFolder>& staging = staging_[id_of(folder, shown)];
  if (!staging) staging = std::make_unique<StagingFolder>(folder, shown);
  return *staging;
}

StagedFile OutputSet::stage(const std::string& path) {
  StagedFile file{path, {}};
  comm_.together([&] {
    if (!comm_.is_root()) return;
    const std::string target = output_target(path);
    if (!targets_.insert(target).second)
      throw OutputError(path + ": two outputs have this name; change one of them");
    file.temporary = staging_beside(target, path).new_file(path);
    outputs_.push_back({file, target});
  });
  return file;
}

std::vector<StagedFile> OutputSet::stage_folder(const std::string& path,
                                                const std::vector<std::string>& files) {
  comm_.together([&] {
    if (!comm_.is_root()) return;
    if (auto made = make_output_folder(path, files)) folders_.push_back(std::move(made));
  });
  std::vector<StagedFile> staged;
  for (const std::string& file : files) staged.push_back(stage(path + "/" + file));
  return staged;
}

void OutputSet::commit() { commit_together(comm_, {this}); }

/// If a signal ends a rank while the others wait for it, no file is renamed: the launcher ends the others
/// too.
void OutputSet::commit_together(const Communicator& comm, std::initializer_list<OutputSet*> sets) {
  for (OutputSet* set : sets) comm.together([&] { set->bring_to_disk(); });
  comm.barrier();
  std::optional<SignalsWait> until_named(std::in_place);
  if (comm.any(SignalsWait::has_come())) {
    until_named.reset();
    comm.barrier();
  }
  for (OutputSet* set : sets) comm.together([&] { set->give_names(); });
}

void OutputSet::bring_to_disk() {
  comm_.together([&] {
    bring_written_to_disk();
    for (const Output& output : outputs_) io::bring_to_disk(output.staged.temporary, output.staged.path);
  });
}

void OutputSet::give_names() {
  comm_.together([&] {
    if (!outputs_.empty()) put_in_place();
  });
}

void OutputSet::bring_written_to_disk() {
  while (!written_.empty()) {
    const auto [descriptor, path] = std::move(written_.back());
    written_.pop_back();
    const int reason = ::fsync(descriptor) == 0 ? 0 : errno;
    if (::close(descriptor) != 0) refuse_output(path, errno);
    if (reason != 0) refuse_output(path, reason);
  }
}

void OutputSet::put_in_place() {
  for (const auto deadline = Clock::now() + patience; Clock::now() < deadline;
       std::this_thread::sleep_for(between_attempts)) {
    const auto locks = lock_all(staging_);
    if (!locks) continue;
    Renaming renaming;
    for (const Output& output : outputs_) renaming.rename(output.staged, output.target);
    renaming.keep();
    outputs_.clear();
    targets_.clear();
    staging_.clear();
    folders_.clear();
    return;
  }
  throw OutputError(
      fmt::format("{}: another run has been writing in its folder for {} s; try again when that has ended",
                  outputs_.front().staged.path, patience.count()));
}

OutputFile::OutputFile(StagedFile staged)
    : staged_{std::move(staged)}, descriptor_{open_for_appending(staged_)} {}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::write(std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor_, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) refuse_output(staged_.path, errno);
    text.remove_prefix(written);
  }
}

void OutputFile::close() {
  if (::close(std::exchange(descriptor_, -1)) != 0) refuse_output(staged_.path, errno);
}

}  // namespace quadloop::io
