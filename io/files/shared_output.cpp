#include "io/files/shared_output.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "io/files/output_path.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

SharedOutput::SharedOutput(const Communicator& comm, std::string path)
    : comm_{comm}, path_{std::move(path)} {}

// From here on the destructor is due, also where another rank cannot open the file.
SharedOutput::SharedOutput(const Communicator& comm, const StagedFile& staged)
    : SharedOutput(comm, staged.path) {
  const std::string temporary = broadcast_words(comm, {staged.temporary}).front();
  comm_.together([&] {
    descriptor_ = ::open(temporary.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor_ >= 0) return;
    if (comm_.is_root()) refuse_output(path_, errno);
    throw OutputError(
        fmt::format("{}: all ranks write this file at once, but rank {} cannot open it ({}); name a folder "
                    "that all machines share, or write a .mesh",
                    path_, comm_.rank(), std::strerror(errno)));
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
  }
}

void SharedOutput::close() {
  comm_.together([&] {
    if (!comm_.is_root() && ::fsync(descriptor_) != 0) refuse_output(path_, errno);
    if (::close(std::exchange(descriptor_, -1)) != 0) refuse_output(path_, errno);
  });
}

}  // namespace quadloop
