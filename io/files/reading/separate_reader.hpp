#pragma once

#include <functional>
#include <string>

#include "io/files/reading/value_pipe.hpp"

namespace quadloop {

namespace detail {

/// What read_separately() does, whatever is read: `produce` runs in the child, `receive` here.
void run_separately(const std::string& path, const std::function<void(PipeWriter&)>& produce,
                    const std::function<void(PipeReader&)>& receive);

}  // namespace detail

/// `read()`, which opens the file at `path` with a library, run in a child process, so that a damaged file
/// can bring down the library but not this process: libcgns and libhdf5 trust what a file says of itself. The
/// child may take processor time and memory in proportion to the file, and calls nothing of MPI. Its Error is
/// thrown here; where it crashes, hangs or asks for too much, an InputError says that the file is damaged.
/// The file is read once: the result (see pass()) comes through a pipe. Not collective.
template <class Result, class Read>
Result read_separately(const std::string& path, const Read& read) {
  Result result{};
  detail::run_separately(
      path,
      [&](PipeWriter& pipe) {
        Result made = read();
        const int done = 0;
        pass(pipe, done);
        pass(pipe, made);
      },
      [&](PipeReader& pipe) { pass(pipe, result); });
  return result;
}

}  // namespace quadloop
