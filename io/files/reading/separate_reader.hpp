#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/files/reading/value_pipe.hpp"

namespace quadloop {

/// How quadloop-reader (io/reader) and a program that starts it talk: `quadloop-reader SECONDS BYTES KIND PATH
/// ...`, what it may take of processor time and of memory before the rest. On its descriptor it sends `begin`,
/// a status, the value or the text of an error, `end`.
struct ReaderProtocol {
  static constexpr int descriptor = 3;
  static constexpr std::uint64_t begin = 0x71'6c'72'65'61'64'00'01;  ///< the last two bytes: its version
  static constexpr std::uint64_t end = ~begin;
  static constexpr int done = 0, too_much_memory = -1;  ///< else an ExitStatus
};

namespace detail {

/// What read_separately() does, whatever is read.
void run_reader(const std::string& kind, const std::string& path, const std::vector<std::string>& more,
                const std::function<void(PipeReader&)>& receive);

}  // namespace detail

/// What a library reads from the file at `path`, in a process of its own, the program quadloop-reader, so that
/// a damaged file can bring down the library but not this process: libcgns and libhdf5 trust what a file says
/// of itself. `kind` and `more` are arguments of that program, which sends a Result (see pass()). It may take
/// processor time and memory in proportion to the file, and knows nothing of MPI. Its Error is thrown here;
/// where it crashes, hangs or asks for too much, an InputError says that the file is damaged; another where
/// the program is not there. Not collective.
template <class Result>
Result read_separately(const std::string& kind, const std::string& path,
                       const std::vector<std::string>& more = {}) {
  Result result{};
  detail::run_reader(kind, path, more, [&](PipeReader& pipe) { pass(pipe, result); });
  return result;
}

}  // namespace quadloop
