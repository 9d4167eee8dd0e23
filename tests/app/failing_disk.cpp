// Loaded before the C library (LD_PRELOAD): calls of the system on files whose path has ".part" in it, as
// outputs on their way have, fail or are slow.
//   QUADLOOP_DISK_CALL    write, fsync, close or rename
//   QUADLOOP_DISK_FULL    the number of the first such call that fails with ENOSPC; all later ones fail too
//   QUADLOOP_DISK_DELAY   milliseconds before each such call
//   QUADLOOP_DISK_SIGNAL  the number of the call before which the process sends itself SIGTERM, on the rank
//                         QUADLOOP_DISK_RANK alone
#include <dlfcn.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string>
#include <string_view>

namespace {

bool is_under_way(std::string_view path) { return path.find(".part") != std::string_view::npos; }

bool is_under_way(int descriptor) {
  std::array<char, 4096> path;
  const ssize_t length =
      ::readlink(("/proc/self/fd/" + std::to_string(descriptor)).c_str(), path.data(), path.size());
  return length > 0 && is_under_way(std::string_view(path.data(), static_cast<std::size_t>(length)));
}

int setting(const char* name) {
  const char* const text = std::getenv(name);
  return text == nullptr ? 0 : std::atoi(text);
}

bool is_chosen_rank() {
  const char* const rank = std::getenv("OMPI_COMM_WORLD_RANK");
  return (rank == nullptr ? 0 : std::atoi(rank)) == setting("QUADLOOP_DISK_RANK");
}

template <class File>
bool fails(std::string_view call, File file) {
  static int calls = 0;
  const char* const chosen = std::getenv("QUADLOOP_DISK_CALL");
  if (chosen == nullptr || call != chosen || !is_under_way(file)) return false;
  ::usleep(static_cast<useconds_t>(setting("QUADLOOP_DISK_DELAY")) * 1000);
  ++calls;
  if (calls == setting("QUADLOOP_DISK_SIGNAL") && is_chosen_rank()) ::raise(SIGTERM);
  const int first = setting("QUADLOOP_DISK_FULL");
  if (first == 0 || calls < first) return false;
  errno = ENOSPC;
  return true;
}

template <class Function>
Function original(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* data, size_t size) {
  return fails("write", descriptor) ? -1 : original<decltype(&::write)>("write")(descriptor, data, size);
}

ssize_t pwrite(int descriptor, const void* data, size_t size, off_t at) {
  return fails("write", descriptor) ? -1
                                    : original<decltype(&::pwrite)>("pwrite")(descriptor, data, size, at);
}

ssize_t pwrite64(int descriptor, const void* data, size_t size, off64_t at) {
  return fails("write", descriptor) ? -1
                                    : original<decltype(&::pwrite64)>("pwrite64")(descriptor, data, size, at);
}

int fsync(int descriptor) {
  return fails("fsync", descriptor) ? -1 : original<decltype(&::fsync)>("fsync")(descriptor);
}

int rename(const char* from, const char* to) {
  return fails("rename", from) ? -1 : original<decltype(&::rename)>("rename")(from, to);
}

// As the system has it: the descriptor is gone all the same.
int close(int descriptor) {
  const bool failing = fails("close", descriptor);
  const int result = original<decltype(&::close)>("close")(descriptor);
  if (!failing) return result;
  errno = ENOSPC;
  return -1;
}
}
