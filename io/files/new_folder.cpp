#include "io/files/new_folder.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>

#include "io/files/output_path.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

namespace fs = std::filesystem;

constexpr mode_t open_to_all = 0777;  // minus the user's umask

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

std::unique_ptr<Temporary> make_output_folder(const std::string& path,
                                              const std::vector<std::string>& files) {
  require_possible_folder(path);
  if (fs::is_directory(path)) {
    refuse_others(path, files);
    return nullptr;
  }
  auto made = std::make_unique<Temporary>(path);
  if (::mkdir(path.c_str(), open_to_all) == 0) return made;
  const int reason = errno;
  if (reason != EEXIST || !fs::is_directory(path)) refuse_output(path, reason);
  refuse_others(path, files);  // another run created it in the meantime
  return nullptr;
}

}  // namespace quadloop::io
