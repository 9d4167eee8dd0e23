#include "io/files/reading/separate_reader.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>

#include "io/files/reading/input_file.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

constexpr const char* cure = "; take it from a copy, or write it anew";

/// Limits for reading a file: generous for any intact one, even with thousands of boundaries (20 s for 100
/// MB) or packed arrays.
struct Allowance {
  std::uint64_t seconds;  ///< CPU time; ten times as much wall clock time
  std::uint64_t bytes;
};

Allowance allowance_for(const std::string& path) {
  require_input_file(path);
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0) throw InputError(path + ": cannot be read: " + std::strerror(errno));
  const std::uint64_t size = about.st_size;
  return {5 + size / (std::uint64_t{1} << 19), (std::uint64_t{1} << 28) + 64 * size};
}

/// The folder of the shared library that contains this code, e.g. of the Python package, or of the program.
std::filesystem::path folder_of_code() {
  Dl_info about{};
  if (::dladdr(reinterpret_cast<const void*>(&allowance_for), &about) == 0 || about.dli_fname == nullptr)
    return {};
  return std::filesystem::path(about.dli_fname).parent_path();
}

/// Returns the path in the environment variable; else next to the program or the library, in the build, or
/// where it is installed.
std::string find_reader(const std::string& path) {
  std::vector<std::string> places;
  if (const char* named = std::getenv("QUADLOOP_READER"); named != nullptr) {
    places.emplace_back(named);
  } else {
    std::error_code unknown;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", unknown);
    if (!unknown) places.push_back((program.parent_path() / QUADLOOP_READER_BESIDE).lexically_normal());
    const std::filesystem::path folder = folder_of_code();
    if (!folder.empty()) places.push_back(folder / "quadloop-reader");
    places.insert(places.end(), {QUADLOOP_READER_BUILT, QUADLOOP_READER_INSTALLED});
  }
  for (const std::string& place : places) {
    if (::access(place.c_str(), X_OK) == 0) return place;
  }
  throw InputError(
      fmt::format("{}: cannot be read: the program that reads such files is not at {}; install "
                  "quadloop again, or set QUADLOOP_READER to the path of quadloop-reader",
                  path, fmt::join(places, ", nor at ")));
}

/// Descriptors and signals of a spawned process.
class SpawnSettings {
 public:
  /// The reader gets `output` as its descriptor and no others. Its signals are those of a new program.
  explicit SpawnSettings(int output) {
    posix_spawn_file_actions_init(&files_);
    posix_spawn_file_actions_adddup2(&files_, output, ReaderProtocol::descriptor);
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
      posix_spawn_file_actions_addopen(&files_, standard, "/dev/null", O_RDWR, 0);
    posix_spawn_file_actions_addclosefrom_np(&files_, ReaderProtocol::descriptor + 1);
    sigset_t all, none;
    sigfillset(&all);
    sigemptyset(&none);
    posix_spawnattr_init(&attributes_);
    posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
    posix_spawnattr_setsigdefault(&attributes_, &all);
    posix_spawnattr_setsigmask(&attributes_, &none);
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&files_);
    posix_spawnattr_destroy(&attributes_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  /// Returns 0, or an errno.
  int start(const std::vector<std::string>& arguments, pid_t& id) const {
    std::vector<char*> pointers;
    for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
    pointers.push_back(nullptr);
    return ::posix_spawn(&id, pointers[0], &files_, &attributes_, pointers.data(), environ);
  }

 private:
  posix_spawn_file_actions_t files_;
  posix_spawnattr_t attributes_;
};

/// The reader process, which is waited for in any case.
class Child {
 public:
  explicit Child(pid_t id) : id_{id} {}
  ~Child() { wait_status(); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  int wait_status() {
    if (!status_) {
      int status = 0;
      while (::waitpid(id_, &status, 0) < 0 && errno == EINTR) {
      }
      status_ = status;
    }
    return *status_;
  }

 private:
  pid_t id_;
  std::optional<int> status_;
};

[[noreturn]] void refuse_ending(const std::string& path, int wait_status, const Allowance& allowance) {
  const int signal = WIFSIGNALED(wait_status) ? WTERMSIG(wait_status) : 0;
  if (signal == SIGXCPU || signal == SIGKILL || signal == SIGALRM) {
    throw InputError(fmt::format("{}: is damaged: reading it did not end within {} seconds{}", path,
                                 allowance.seconds, cure));
  }
  const std::string how = signal != 0 ? fmt::format("crashed ({})", ::strsignal(signal)) : "gave up";
  throw InputError(fmt::format("{}: is damaged: the library that reads it {}{}", path, how, cure));
}

[[noreturn]] void rethrow(const std::string& path, int status, const std::string& message,
                          const Allowance& allowance) {
  if (status == ReaderProtocol::too_much_memory) {
    throw InputError(fmt::format(
        "{}: is damaged: reading it takes more than {} MB of memory, which its size does not explain{}", path,
        allowance.bytes >> 20, cure));
  }
  if (status == static_cast<int>(ExitStatus::bad_input)) throw InputError(message);
  throw Error(static_cast<ExitStatus>(status), message);
}

/// Receives the reader's data up to its end. `has_begun`: whether it has sent anything.
void take(PipeReader& pipe, const std::string& path, const std::string& reader, const Allowance& allowance,
          std::uint64_t wanted_begin, const std::function<void(PipeReader&)>& receive, bool& has_begun) {
  std::uint64_t begin = 0, end = 0;
  int status = 0;
  pass(pipe, begin);
  has_begun = true;
  if (begin != wanted_begin)
    throw InputError(path + ": cannot be read: " + reader +
                     " is of another version than this program; install quadloop again");
  pass(pipe, status);
  std::string message;
  status == ReaderProtocol::done ? receive(pipe) : pass(pipe, message);
  pass(pipe, end);
  if (end != ReaderProtocol::end)
    throw InputError(path + ": is damaged: what was read from it did not come through" + cure);
  if (status != ReaderProtocol::done) rethrow(path, status, message, allowance);
}

}  // namespace

namespace detail {

void run_reader(const std::string& kind, const std::string& path, const std::vector<std::string>& more,
                std::uint64_t begin, const std::function<void(PipeReader&)>& receive) {
  const Allowance allowance = allowance_for(path);
  const std::string reader = find_reader(path);
  std::vector<std::string> arguments{reader, std::to_string(allowance.seconds),
                                     std::to_string(allowance.bytes), kind, path};
  arguments.insert(arguments.end(), more.begin(), more.end());
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw InputError(path + ": cannot be read: no pipe: " + std::strerror(errno));
  pid_t id = 0;
  const int failure = SpawnSettings(ends[1]).start(arguments, id);
  ::close(ends[1]);
  if (failure != 0) {
    ::close(ends[0]);
    throw InputError(path + ": cannot be read: " + reader + " cannot be started: " + std::strerror(failure));
  }
  Child child(id);
  PipeReader pipe(ends[0]);  // closed before waiting for the reader, which then has no receiver
  bool has_begun = false;
  try {
    take(pipe, path, reader, allowance, begin, receive, has_begun);
  } catch (const PipeEnded&) {
    const int status = child.wait_status();
    if (!has_begun && WIFEXITED(status))
      throw InputError(
          fmt::format("{}: cannot be read: {} ended at once, with status {}; install quadloop again", path,
                      reader, WEXITSTATUS(status)));
    refuse_ending(path, status, allowance);
  }
}

}  // namespace detail

}  // namespace quadloop::io
