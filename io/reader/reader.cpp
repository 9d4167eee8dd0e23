// quadloop-reader: reads one file with libcgns or HDF5 and sends its contents to the program that started it
// (io/files/reading/separate_reader.hpp). A damaged file may crash these libraries, or make them loop or use
// all memory: this ends only this process, silently.
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
#include "io/model/serialize_mesh.hpp"
#include "io/tree/tree_share.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

/// Returns the writable memory of this process, in bytes, as counted by RLIMIT_DATA.
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

void send_error(PipeWriter& pipe, int status, std::string message) {
  pass(pipe, status);
  pass(pipe, message);
}

/// What `read()` gives, or its error.
template <class Read>
void answer(const Read& read) {
  using Value = decltype(read());
  PipeWriter pipe(ReaderProtocol::descriptor);
  std::uint64_t begin = ReaderProtocol::begin<Value>(), end = ReaderProtocol::end;
  pass(pipe, begin);
  pipe.flush();
  try {
    Value value = read();
    int status = ReaderProtocol::done;
    pass(pipe, status);
    pass(pipe, value);
  } catch (const Error& error) {
    send_error(pipe, static_cast<int>(error.status()), error.what());
  } catch (const std::bad_alloc&) {
    send_error(pipe, ReaderProtocol::too_much_memory, "");
  } catch (const std::exception& error) {
    send_error(pipe, static_cast<int>(ExitStatus::fault), error.what());
  }
  pass(pipe, end);
  pipe.flush();
}

void answer_to(const std::vector<std::string>& arguments) {
  const std::string& path = arguments.at(3);
  if (arguments.at(2) == "cgns") {
    const bool whole = arguments.size() > 4 && arguments[4] == "whole";
    answer([&] { return read_cgns_by_library(path, !whole); });
  } else {
    answer([&] { return read_tree_share(path, std::stoll(arguments.at(4)), std::stoll(arguments.at(5))); });
  }
}

}  // namespace

}  // namespace quadloop::io

int main(int count, char** texts) {
  const std::vector<std::string> arguments(texts + 1, texts + count);
  if (arguments.size() < 4) return static_cast<int>(quadloop::ExitStatus::wrong_usage);
  std::signal(SIGPIPE, SIG_IGN);
  std::atexit([] {
    ::_exit(EXIT_FAILURE);
  });  // libcgns calls exit() when memory runs out; exit handlers of libraries could crash on the data read
  quadloop::io::limit_costs(std::stoull(arguments[0]), std::stoull(arguments[1]));
  quadloop::io::answer_to(arguments);
  ::_exit(EXIT_SUCCESS);
}
