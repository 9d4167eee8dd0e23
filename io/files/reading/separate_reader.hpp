#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/files/reading/value_pipe.hpp"

namespace quadloop::io {

/// Protocol between quadloop-reader (io/reader) and the program that starts it with `quadloop-reader SECONDS
/// BYTES KIND PATH ...`; the first two arguments limit CPU time and memory. On its descriptor the reader
/// sends `begin`, a status, the value or an error message, `end`.
struct ReaderProtocol {
  static constexpr int descriptor = 3;
  static constexpr std::uint64_t version = 1, end = 0x71'6c'72'65'61'64'65'72;

  /// Before a value of this type.
  template <class Value>
  static std::uint64_t begin() {
    return signature_of<Value>() + version;
  }
  static constexpr int done = 0, too_much_memory = -1;  ///< other values: an ExitStatus
};

namespace detail {

/// Implementation of read_separately() for any data.
void run_reader(const std::string& kind, const std::string& path, const std::vector<std::string>& more,
                std::uint64_t begin, const std::function<void(PipeReader&)>& receive);

}  // namespace detail

/// Reads the file at `path` with a library in a separate process, the program quadloop-reader, so that a
/// damaged file can crash the library but not this process: libcgns and libhdf5 do not validate files. `kind`
/// and `more` are arguments of that program, which sends a Result (see pass()). Its CPU time and memory are
/// limited in proportion to the file size, and it does not use MPI. Its Error is thrown here; if it crashes,
/// hangs or exceeds the limits, an InputError says that the file is damaged; another one if the program is
/// missing. Not collective.
template <class Result>
Result read_separately(const std::string& kind, const std::string& path,
                       const std::vector<std::string>& more = {}) {
  Result result{};
  detail::run_reader(kind, path, more, ReaderProtocol::begin<Result>(),
                     [&](PipeReader& pipe) { pass(pipe, result); });
  return result;
}

}  // namespace quadloop::io
