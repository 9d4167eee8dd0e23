#include "io/files/shared_output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <exception>
#include <span>
#include <utility>

#include "io/files/output_path.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

// write-back starts from this size, while more data are created
constexpr std::int64_t bytes_to_begin_with = std::int64_t{1} << 22;
constexpr std::int64_t no_more = -1;  // instead of an offset, after the last bytes that a rank sends

}  // namespace

SharedOutput::SharedOutput(OutputSet& outputs, std::string path)
    : outputs_{outputs}, path_{std::move(path)} {}

// From here on the destructor is called, even if rank 0 cannot open the file.
SharedOutput::SharedOutput(OutputSet& outputs, const StagedFile& staged)
    : SharedOutput(outputs, staged.path) {
  const Communicator& comm = communicator();
  const std::string temporary = broadcast_words(comm, {staged.temporary}).front();
  comm.together([&] {
    descriptor_ = ::open(temporary.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC);
    if (is_relayed() && comm.is_root()) refuse_output(path_, errno);
  });
  const std::vector<int> own(is_relayed() ? 1 : 0, comm.rank());
  relayed_ = comm.all_gather_values(std::span<const int>(own));
}

SharedOutput::~SharedOutput() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

/// After a failure of rank 0 the others' bytes are still received, as those ranks would otherwise wait
/// forever.
void SharedOutput::together(const std::function<void()>& action) {
  communicator().together([&] {
    std::exception_ptr failure;
    const auto attempt = [&](const auto& step) {
      try {
        step();
      } catch (...) {
        if (!failure) failure = std::current_exception();
      }
    };
    attempt(action);
    if (is_relayed()) send(no_more, {});
    if (communicator().is_root()) attempt([&] { write_of_others(); });
    if (failure) std::rethrow_exception(failure);
  });
}

void SharedOutput::write_at(std::int64_t offset, std::string_view bytes) {
  if (bytes.empty()) return;
  is_relayed() ? send(offset, bytes) : write_here(offset, bytes);
}

void SharedOutput::write_here(std::int64_t offset, std::string_view bytes) {
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

void SharedOutput::send(std::int64_t offset, std::string_view bytes) const {
  communicator().send_bytes(std::as_bytes(std::span(&offset, 1)), 0);
  if (offset != no_more) communicator().send_bytes(std::as_bytes(std::span(bytes)), 0);
}

void SharedOutput::write_of_others() {
  std::exception_ptr failure;
  for (const int rank : relayed_) {
    try {
      write_of(rank);
    } catch (...) {
      if (!failure) failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

/// Receives everything that a rank sends, even if writing it fails.
void SharedOutput::write_of(int rank) {
  std::exception_ptr failure;
  while (true) {
    const std::int64_t offset = detail::from_bytes<std::int64_t>(communicator().receive_bytes(rank)).front();
    if (offset == no_more) break;
    const std::vector<std::byte> bytes = communicator().receive_bytes(rank);
    if (failure) continue;
    try {
      write_here(offset, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    } catch (...) {
      failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

/// Starts write-back without waiting; if this fails, it is done later.
void SharedOutput::begin_on_disk() {
  ::sync_file_range(descriptor_, 0, 0, SYNC_FILE_RANGE_WRITE);
  waiting_ = 0;
}

/// Rank 0 flushes every staged file by its name on commit; the other ranks, which may be on other machines,
/// flush what they wrote.
void SharedOutput::close() {
  communicator().together([&] {
    if (is_relayed()) return;
    begin_on_disk();
    const int descriptor = std::exchange(descriptor_, -1);
    if (!communicator().is_root()) return outputs_.take_over(descriptor, path_);
    if (::close(descriptor) != 0) refuse_output(path_, errno);
  });
}

}  // namespace quadloop::io
