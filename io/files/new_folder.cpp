#include "io/files/new_folder.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "io/files/output_path.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

namespace fs = std::filesystem;

constexpr mode_t open_to_all = 0777;  // less the user's umask

void refuse_others(const std::string& path, const std::vector<std::string>& files) {
  std::error_code failure;
  for (fs::directory_iterator entry(path, failure), end; !failure && entry != end; entry.increment(failure)) {
    const std::string name = entry->path().filename();
    if (name.starts_with('.') || std::ranges::count(files, name) > 0) continue;
    throw OutputError(path + ": holds '" + name +
                      "', which does not belong to this output; remove it, or choose another folder");
  }
}

}  // namespace

NewFolder NewFolder::at(const std::string& path, const std::vector<std::string>& files) {
  NewFolder folder;
  if (fs::is_directory(path)) {
    refuse_others(path, files);
    return folder;
  }
  if (fs::exists(path)) throw OutputError(path + ": is no folder; choose another name");
  const std::string parent = folder_of(path);
  if (!fs::is_directory(parent))
    throw OutputError(path + ": cannot be written: the folder '" + parent +
                      "' does not exist; create it first");
  folder.made_ = std::make_unique<Temporary>(path);
  if (::mkdir(path.c_str(), open_to_all) != 0) {
    const int reason = errno;
    folder.keep();
    if (reason != EEXIST || !fs::is_directory(path)) refuse_output(path, reason);
    refuse_others(path, files);  // another run made it in the meantime
  }
  return folder;
}

NewFolder::~NewFolder() {
  if (made_) ::rmdir(made_->path().c_str());
}

}  // namespace quadloop
