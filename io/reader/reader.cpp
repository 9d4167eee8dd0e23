// quadloop-reader: reads one file with libcgns or HDF5 and sends what it holds to the program that started it
// (io/files/reading/separate_reader.hpp). A damaged file may crash these libraries, or make them loop or take
// all memory: that ends this process alone, in silence.
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <new>
#include <string>
#include <vector>

#include "io/cgns/cgns_input.hpp"
#include "io/files/reading/separate_reader.hpp"
#include "io/model/pass_mesh.hpp"
#include "io/tree/tree_share.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

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

void limit_costs(rlim_t seconds, rlim_t bytes) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, seconds);
  ::alarm(static_cast<unsigned>(10 * seconds));
  if (const rlim_t data = own_data(); data > 0) limit(RLIMIT_DATA, data + bytes);
}

template <class Value>
void send(PipeWriter& pipe, int status, Value value) {
  pass(pipe, status);
  pass(pipe, value);
}

void send_file(PipeWriter& pipe, const std::vector<std::string>& arguments) {
  const std::string &kind = arguments.at(2), &path = arguments.at(3);
  if (kind == "cgns") {
    send(pipe, ReaderProtocol::done, read_cgns_by_library(path));
  } else {
    send(pipe, ReaderProtocol::done,
         read_tree_share(path, std::stoll(arguments.at(4)), std::stoll(arguments.at(5))));
  }
}

void answer(const std::vector<std::string>& arguments) {
  PipeWriter pipe(ReaderProtocol::descriptor);
  std::uint64_t begin = ReaderProtocol::begin, end = ReaderProtocol::end;
  pass(pipe, begin);
  pipe.flush();
  try {
    send_file(pipe, arguments);
  } catch (const Error& error) {
    send(pipe, static_cast<int>(error.status()), std::string(error.what()));
  } catch (const std::bad_alloc&) {
    send(pipe, ReaderProtocol::too_much_memory, std::string());
  } catch (const std::exception& error) {
    send(pipe, static_cast<int>(ExitStatus::fault), std::string(error.what()));
  }
  pass(pipe, end);
  pipe.flush();
}

}  // namespace

}  // namespace quadloop

int main(int count, char** texts) {
  const std::vector<std::string> arguments(texts + 1, texts + count);
  if (arguments.size() < 4) return static_cast<int>(quadloop::ExitStatus::wrong_usage);
  std::signal(SIGPIPE, SIG_IGN);
  std::atexit([] {
    ::_exit(EXIT_FAILURE);
  });  // libcgns calls exit() where memory runs out; what libraries do at the end could crash on what they read
  quadloop::limit_costs(std::stoull(arguments[0]), std::stoull(arguments[1]));
  quadloop::answer(arguments);
  ::_exit(EXIT_SUCCESS);
}
