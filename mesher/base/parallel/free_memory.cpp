#include "mesher/base/parallel/free_memory.hpp"

#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <optional>
#include <sstream>

namespace quadloop {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr double kib = 1024;

/// Returns the number after a word of a text file, e.g. "MemAvailable: 123 kB"; the file's first number if
/// the word is empty.
std::optional<double> number_in(const std::string& path, const std::string& word) {
  std::ifstream file(path);
  if (word.empty()) {
    double number = 0;
    if (file >> number) return number;
    return {};
  }
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string first;
    double number = 0;
    if (words >> first && first == word && words >> number) return number;
  }
  return {};
}

/// Returns the free memory of one control group; reclaimable file pages count as free.
double free_in_group(const std::string& folder, const char* limit, const char* usage,
                     const char* reclaimable) {
  const auto most = number_in(folder + limit, ""), used = number_in(folder + usage, "");
  if (!most || !used) return unlimited;
  return std::max(0.0, *most - *used + number_in(folder + "/memory.stat", reclaimable).value_or(0));
}

/// Returns a limit of this process minus its usage.
double left_of(int resource, const char* taken) {
  rlimit limit{};
  if (getrlimit(static_cast<decltype(RLIMIT_AS)>(resource), &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return unlimited;
  return std::max(
      0.0, static_cast<double>(limit.rlim_cur) - kib * number_in("/proc/self/status", taken).value_or(0));
}

std::size_t name_of_machine() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return std::hash<std::string>{}(name.data());
}

double free_on_machine() {
  const double free_pages = kib * number_in("/proc/meminfo", "MemAvailable:").value_or(unlimited);
  std::ifstream membership("/proc/self/cgroup");
  std::ostringstream text;
  text << membership.rdbuf();
  return std::min(free_pages, free_in_control_groups(text.str(), "/sys/fs/cgroup"));
}

double free_of_process() { return std::min(left_of(RLIMIT_AS, "VmSize:"), left_of(RLIMIT_DATA, "VmData:")); }

}  // namespace

double free_in_control_groups(const std::string& membership, const std::string& root) {
  double least = unlimited;
  std::istringstream lines(membership);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find(':'), second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool unified = controllers.empty();
    if (!unified && ("," + controllers + ",").find(",memory,") == std::string::npos) continue;
    const std::string mounted = unified ? root : root + "/memory";
    for (std::filesystem::path group = line.substr(second + 1);;
         group = group.parent_path()) {  // parent groups are limits too
      const std::string folder = mounted + (group == "/" ? "" : group.string());
      least =
          std::min(least, unified ? free_in_group(folder, "/memory.max", "/memory.current", "inactive_file")
                                  : free_in_group(folder, "/memory.limit_in_bytes", "/memory.usage_in_bytes",
                                                  "total_inactive_file"));
      if (!group.has_relative_path()) break;
    }
  }
  return least;
}

void return_freed_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

double free_memory_of_all(const Communicator& comm) {
  const std::size_t machine = name_of_machine();
  const std::vector<std::size_t> machines = comm.all_gather(machine);
  const auto sharing = static_cast<double>(std::count(machines.begin(), machines.end(), machine));
  return comm.size() * comm.minimum(std::min(free_on_machine() / sharing, free_of_process()));
}

}  // namespace quadloop
