#include "io/files/shared_output.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "io/files/output_path.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

// write-back starts from this size, while more data are created
constexpr std::int64_t bytes_to_begin_with = std::int64_t{1} << 22;

/// Returns -1, and sets errno, if this rank cannot open the file.
int open_staged(const std::string& temporary) {
  return ::open(temporary.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC);
}

std::string name_on_all(const Communicator& comm, const StagedFile& staged) {
  return broadcast_words(comm, {staged.temporary}).front();
}

}  // namespace

SharedOutput::SharedOutput(OutputSet& outputs, std::string path)
    : outputs_{outputs}, path_{std::move(path)} {}

// From here on the destructor is called, even if another rank cannot open the file.
SharedOutput::SharedOutput(OutputSet& outputs, const StagedFile& staged, Writers writers)
    : SharedOutput(outputs, staged.path) {
  const Communicator& comm = outputs.communicator();
  const std::string temporary = name_on_all(comm, staged);
  comm.together([&] {
    if (writers == Writers::root && !comm.is_root()) return;
    descriptor_ = open_staged(temporary);
    if (descriptor_ >= 0) return;
    if (comm.is_root()) refuse_output(path_, errno);
    throw OutputError(
        fmt::format("{}: all ranks write this file at once, but rank {} cannot open it ({}); name a folder "
                    "that all machines share, or write a .mesh",
                    path_, comm.rank(), std::strerror(errno)));
  });
}

SharedOutput::~SharedOutput() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void SharedOutput::write_at(std::int64_t offset, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(descriptor_, bytes.data(), bytes.size(), offset);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) refuse_output(path_, errno);
    bytes.remove_prefix(written);
    offset += written;
    waiting_ += written;
  }
  if (waiting_ >= bytes_to_begin_with) begin_on_disk();
}

/// Starts write-back without waiting; if this fails, it is done later.
void SharedOutput::begin_on_disk() {
  ::sync_file_range(descriptor_, 0, 0, SYNC_FILE_RANGE_WRITE);
  waiting_ = 0;
}

void SharedOutput::close() {
  if (descriptor_ >= 0) {
    begin_on_disk();
    outputs_.take_over(std::exchange(descriptor_, -1), path_);
  }
  outputs_.communicator().barrier();
}

bool reached_by_all(const Communicator& comm, const StagedFile& staged) {
  const int descriptor = open_staged(name_on_all(comm, staged));
  if (descriptor >= 0) ::close(descriptor);
  return !comm.any(descriptor < 0);
}

}  // namespace quadloop::io
