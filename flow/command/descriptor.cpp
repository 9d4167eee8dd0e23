#include "flow/command/descriptor.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

constexpr int lowest_number = 10;
constexpr mode_t readable_by_all = 0666;  // less the user's umask

[[noreturn]] void no_descriptor_left(int reason) {
  throw OutputError(std::string("no more files can be opened: ") + std::strerror(reason) +
                    "; raise the limit of open files (ulimit -n)");
}

}  // namespace

Descriptor::Descriptor(int raw) {
  number_ = ::fcntl(raw, F_DUPFD_CLOEXEC, lowest_number);
  const int reason = errno;
  ::close(raw);
  if (number_ < 0) no_descriptor_left(reason);
}

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(number_, other.number_);
  return *this;
}

void Descriptor::close() {
  if (number_ >= 0) ::close(number_);
  number_ = -1;
}

Descriptor open_descriptor(const std::string& path, int flags) {
  const int raw = ::open(path.c_str(), flags | O_CLOEXEC, readable_by_all);
  if (raw < 0)
    throw OutputError(path + ": cannot be opened: " + std::strerror(errno) + "; the solver needs it");
  return Descriptor(raw);
}

Pipe make_pipe() {
  int ends[2] = {};
  if (::pipe2(ends, O_CLOEXEC) != 0) no_descriptor_left(errno);
  Pipe pipe;
  pipe.reading = Descriptor(ends[0]);
  pipe.writing = Descriptor(ends[1]);
  return pipe;
}

}  // namespace quadloop
