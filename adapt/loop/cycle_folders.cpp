#include "adapt/loop/cycle_folders.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "adapt/solvers/cycle_paths.hpp"
#include "io/files/output_path.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::adapt {

namespace {

namespace fs = std::filesystem;

/// Runs `work`, converting file system errors to errors of quadloop.
template <class Work>
void on_disk(const std::string& path, const Work& work) {
  try {
    work();
  } catch (const fs::filesystem_error& fault) {
    io::refuse_output(path, fault.code().value());
  }
}

/// Whether a folder is empty except for the remains of a first cycle that failed.
bool holds_nothing_whole(const fs::path& folder, const fs::path& first_under_way, const fs::path& start) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const fs::path name = entry.path().filename();
    if (name != first_under_way.filename() && name != start.filename()) return false;
  }
  return true;
}

/// Returns the digest at the beginning of a start line.
std::string digest_of_start(const std::string& start) { return start.substr(0, start.find(' ')); }

}  // namespace

CycleFolders::CycleFolders(const Communicator& comm, std::string folder)
    : comm_{comm}, folder_{std::move(folder)} {}

CycleFolders::~CycleFolders() {
  if (lock_ >= 0) ::close(lock_);
}

std::string CycleFolders::whole(int cycle) const { return folder_ + "/" + cycle_name(cycle); }

void CycleFolders::lock() {
  lock_ = ::open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (lock_ < 0) io::refuse_output(folder_, errno);
  // Some network file systems do not support such locks; the run then proceeds without one.
  if (::flock(lock_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  throw InputError(folder_ +
                   ": another run is using this folder; wait until it ends, or choose another folder");
}

int CycleFolders::count_whole() const {
  int cycles = 0;
  while (fs::is_directory(whole(cycles))) ++cycles;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    const std::string name = entry.path().filename();
    int later = 0;
    if (std::sscanf(name.c_str(), "cycle_%d", &later) != 1 || later <= cycles ||
        fs::path(whole(later)).filename() != name)
      continue;
    throw InputError(
        fmt::format("{}: is missing, but {} exists; restore it, or remove the later cycles and resume the "
                    "run, which repeats them",
                    whole(cycles), name));
  }
  return cycles;
}

std::string CycleFolders::start_file() const { return folder_ + "/start.txt"; }

void CycleFolders::settle_start(bool resume, const std::string& start) const {
  std::string before;
  std::getline(std::ifstream(start_file()), before);
  const bool has_begun = !before.empty() || fs::exists(under_way(0));
  if (resume && has_begun && digest_of_start(before) != digest_of_start(start)) {
    if (before.empty())
      throw InputError(
          folder_ +
          ": the run in it began with the mesh of its case and has no complete cycle yet; resume "
          "it so, or choose another folder");
    throw InputError(fmt::format(
        "{}: the run in it began with the mesh of {} and has no complete cycle yet; resume it with "
        "the same one, or choose another folder",
        folder_, before.substr(before.find(' ') + 1)));
  }
  fs::remove(start_file());
  if (start.empty()) return;
  std::ofstream file(start_file());
  file << start << "\n";
  file.close();
  if (!file) io::refuse_output(start_file(), EIO);
  io::bring_to_disk(start_file(), start_file());
}

int CycleFolders::open(bool resume, const std::string& start) {
  int cycles = 0;
  comm_.together([&] {
    if (!comm_.is_root()) return;
    on_disk(folder_, [&] {
      if (fs::exists(folder_) && !fs::is_directory(folder_))
        throw InputError(folder_ + ": is a file, not a folder; choose another name");
      fs::create_directories(folder_);
      lock();
      if (!resume && !holds_nothing_whole(folder_, under_way(0), start_file())) {
        throw InputError(folder_ + ": is not empty; resume the run in it, or choose another folder");
      }
      cycles = count_whole();
      if (cycles == 0) settle_start(resume, start);
      fs::remove_all(under_way(cycles));
    });
  });
  return static_cast<int>(comm_.maximum(std::int64_t{cycles}));
}

void CycleFolders::begin(int cycle) {
  comm_.together([&] {
    if (!comm_.is_root()) return;
    on_disk(under_way(cycle), [&] {
      fs::remove_all(under_way(cycle));
      if (!fs::create_directory(under_way(cycle))) io::refuse_output(under_way(cycle), EEXIST);
    });
  });
}

void CycleFolders::discard(int cycle) {
  std::error_code ignored;
  if (comm_.is_root()) fs::remove_all(under_way(cycle), ignored);
}

void CycleFolders::finish(int cycle) {
  comm_.together([&] {
    if (!comm_.is_root()) return;
    on_disk(whole(cycle), [&] {
      for (const fs::directory_entry& entry : fs::directory_iterator(under_way(cycle))) {
        if (entry.is_regular_file()) io::bring_to_disk(entry.path(), entry.path());
      }
      io::bring_to_disk(under_way(cycle), whole(cycle));
      fs::rename(under_way(cycle), whole(cycle));
      io::bring_to_disk(folder_, whole(cycle));
    });
  });
}

}  // namespace quadloop::adapt
