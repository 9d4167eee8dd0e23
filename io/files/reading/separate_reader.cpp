#include "io/files/reading/separate_reader.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <new>
#include <optional>

#include "io/files/reading/input_file.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

constexpr const char* cure = "; restore it from a copy, or write it again";
constexpr int too_much_memory = -1;  // sent in place of an exit status

/// What reading a file may cost: generous for every whole one, also for thousands of boundaries (20 s for 100
/// MB) and packed arrays.
struct Allowance {
  rlim_t seconds;  ///< of the processor; ten times as much by the clock
  rlim_t bytes;
};

Allowance allowance_for(rlim_t file_size) {
  return {5 + file_size / (rlim_t{1} << 19), (rlim_t{1} << 28) + 64 * file_size};
}

rlim_t size_of_file(const std::string& path) {
  require_input_file(path);
  struct stat about {};
  if (::stat(path.c_str(), &about) != 0) throw InputError(path + ": cannot be read: " + std::strerror(errno));
  return about.st_size;
}

/// Bytes of memory that this process may write to, as RLIMIT_DATA counts them.
rlim_t own_data() {
  std::ifstream file("/proc/self/statm");
  std::array<rlim_t, 6> pages{};
  for (rlim_t& number : pages) file >> number;
  return file ? pages[5] * ::sysconf(_SC_PAGESIZE) : 0;
}

void limit(int what, rlim_t value) {
  const rlimit both{value, value};
  ::setrlimit(static_cast<__rlimit_resource>(what), &both);
}

/// Crashes end the child and nothing else, in silence: handlers and outputs are the parent's.
void become_separate(const Allowance& allowance) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGXCPU, SIGALRM, SIGINT, SIGTERM})
    ::signal(signal, SIG_DFL);
  ::signal(SIGPIPE, SIG_IGN);
  const int nowhere = ::open("/dev/null", O_RDWR);
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, descriptor);
  std::atexit([] {
    ::_exit(EXIT_FAILURE);
  });  // libcgns calls exit() where memory runs out; what MPI and others left for the end is not the child's
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, allowance.seconds);
  ::alarm(static_cast<unsigned>(10 * allowance.seconds));
  if (const rlim_t data = own_data(); data > 0) limit(RLIMIT_DATA, data + allowance.bytes);
}

void send_error(PipeWriter& pipe, int status, std::string message) {
  pass(pipe, status);
  pass(pipe, message);
}

[[noreturn]] void run_child(int descriptor, const Allowance& allowance,
                            const std::function<void(PipeWriter&)>& produce) {
  become_separate(allowance);
  PipeWriter pipe(descriptor);
  try {
    produce(pipe);
  } catch (const Error& error) {
    send_error(pipe, static_cast<int>(error.status()), error.what());
  } catch (const std::bad_alloc&) {
    send_error(pipe, too_much_memory, "");
  } catch (const std::exception& error) {
    send_error(pipe, static_cast<int>(ExitStatus::fault), error.what());
  }
  pipe.flush();
  ::_exit(EXIT_SUCCESS);
}

/// The child, which is waited for however its parent goes on.
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
  if (status == too_much_memory) {
    throw InputError(fmt::format(
        "{}: is damaged: reading it takes more than {} MB of memory, which its size does not explain{}", path,
        allowance.bytes >> 20, cure));
  }
  if (status == static_cast<int>(ExitStatus::bad_input)) throw InputError(message);
  throw Error(static_cast<ExitStatus>(status), message);
}

/// What the child has to say, up to its end.
void take(PipeReader& pipe, const std::string& path, const Allowance& allowance,
          const std::function<void(PipeReader&)>& receive) {
  int status = 0;
  pass(pipe, status);
  if (status == 0) {
    receive(pipe);
    return;
  }
  std::string message;
  pass(pipe, message);
  rethrow(path, status, message, allowance);
}

}  // namespace

namespace detail {

void run_separately(const std::string& path, const std::function<void(PipeWriter&)>& produce,
                    const std::function<void(PipeReader&)>& receive) {
  const Allowance allowance = allowance_for(size_of_file(path));
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw InputError(path + ": cannot be read: no pipe: " + std::strerror(errno));
  const pid_t id = ::fork();
  if (id == 0) {
    ::close(ends[0]);
    run_child(ends[1], allowance, produce);
  }
  const int failure = errno;
  ::close(ends[1]);
  if (id < 0) {
    ::close(ends[0]);
    throw InputError(path + ": cannot be read: no process can be started for it: " + std::strerror(failure));
  }
  Child child(id);
  PipeReader pipe(ends[0]);  // closed before the child is waited for, which then has nobody to write to
  try {
    take(pipe, path, allowance, receive);
  } catch (const PipeEnded&) {
    refuse_ending(path, child.wait_status(), allowance);
  }
}

}  // namespace detail

}  // namespace quadloop
