#include "io/files/reading/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <new>
#include <stdexcept>

#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

constexpr std::size_t piece = std::size_t{1} << 20;
constexpr std::size_t most_of_a_pipe = std::size_t{1} << 28;

bool pipes_allowed = false;

[[noreturn]] void refuse_opening(const std::string& path, int reason) {
  const char* const cure = reason == ENAMETOOLONG ? "give a shorter name" : "check the name and its folder";
  throw InputError(path + ": cannot be opened (" + std::strerror(reason) + "); " + cure);
}

[[noreturn]] void refuse_reading(const std::string& path, int reason) {
  throw InputError(path + ": cannot be read to its end (" + std::strerror(reason) + ")");
}

[[noreturn]] void refuse_changed(const std::string& path) {
  throw InputError(path + ": ended while it was being read; another program may still be writing it");
}

}  // namespace

/// An open file.
class InputDescriptor {
 public:
  explicit InputDescriptor(const std::string& path) : number_{::open(path.c_str(), O_RDONLY | O_CLOEXEC)} {
    if (number_ < 0) refuse_opening(path, errno);
  }
  ~InputDescriptor() { ::close(number_); }
  InputDescriptor(const InputDescriptor&) = delete;
  InputDescriptor& operator=(const InputDescriptor&) = delete;

  /// Returns 0 at the end.
  std::size_t read(char* into, std::size_t size, const std::string& path) const {
    for (;;) {
      const ssize_t got = ::read(number_, into, size);
      if (got >= 0) return got;
      if (errno != EINTR) refuse_reading(path, errno);
    }
  }

  std::size_t read_at(std::int64_t place, std::span<std::byte> into, const std::string& path) const {
    for (;;) {
      const ssize_t got = ::pread(number_, into.data(), into.size(), place);
      if (got >= 0) return got;
      if (errno != EINTR) refuse_reading(path, errno);
    }
  }

 private:
  int number_;
};

namespace {

/// Checked before opening, which alone would block on a pipe without a writer.
struct stat require_readable_kind(const std::string& path, bool pipes) {
  struct stat found = {};
  if (::stat(path.c_str(), &found) != 0) refuse_opening(path, errno);
  if (S_ISDIR(found.st_mode)) throw InputError(path + ": is a folder; name a file in it");
  if (S_ISFIFO(found.st_mode) && !pipes)
    throw InputError(path +
                     ": is a pipe, which cannot be read here; save what it gives as a file and name that");
  if (!S_ISREG(found.st_mode) && !S_ISFIFO(found.st_mode))
    throw InputError(path + ": is a device, not a file; name a file");
  return found;
}

std::string read_file(const std::string& path, std::size_t size) {
  const InputDescriptor file(path);
  std::string text(size, '\0');
  std::size_t used = 0;
  while (used < size) {
    const std::size_t got = file.read(text.data() + used, size - used, path);
    if (got == 0) break;
    used += got;
  }
  text.resize(used);
  return text;
}

std::string read_pipe(const std::string& path) {
  InputPieces pipe(path);
  std::string text;
  for (std::size_t before = text.size();; before = text.size()) {
    pipe.append_next(text);
    if (text.size() == before) return text;
  }
}

}  // namespace

void require_input_file(const std::string& path) { require_readable_kind(path, false); }

std::string read_input(const std::string& path) {
  const struct stat found = require_readable_kind(path, pipes_allowed);
  if (!S_ISREG(found.st_mode)) return read_pipe(path);
  const std::size_t size = found.st_size;
  try {
    return read_file(path, size);
  } catch (const std::bad_alloc&) {
  } catch (const std::length_error&) {
  }
  throw InputError(path + ": has " + std::to_string(size) +
                   " bytes, more than there is memory for; use a machine with more");
}

InputPieces::InputPieces(const std::string& path) : path_{path} {
  const struct stat found = require_readable_kind(path, pipes_allowed);
  is_pipe_ = !S_ISREG(found.st_mode);
  if (!is_pipe_) bytes_left_ = found.st_size;
  file_ = std::make_unique<InputDescriptor>(path);
}

InputPieces::~InputPieces() = default;

void InputPieces::append_next(std::string& text) {
  if (is_pipe_ && taken_ > most_of_a_pipe)
    throw InputError(path_ +
                     ": a pipe that gives more than 256 MB; save what it gives as a file and name that");
  const std::size_t before = text.size();
  text.resize(before + piece);
  const std::size_t got = file_->read(text.data() + before, piece, path_);
  text.resize(before + got);
  taken_ += got;
  bytes_left_ -= std::min(bytes_left_, got);
}

void InputPieces::read_all(char* into, std::size_t size) {
  while (size > 0) {
    const std::size_t got = file_->read(into, size, path_);
    if (got == 0) refuse_changed(path_);
    into += got;
    size -= got;
    bytes_left_ -= std::min(bytes_left_, got);
  }
}

PlacedInput::PlacedInput(const std::string& path, bool keeps_pipe) : path_{path} {
  const struct stat found = require_readable_kind(path, keeps_pipe && pipes_allowed);
  if (S_ISFIFO(found.st_mode)) {
    kept_ = read_input(path);
    size_ = std::ssize(kept_);
  } else {
    file_ = std::make_unique<InputDescriptor>(path);
    size_ = found.st_size;
  }
}

PlacedInput::~PlacedInput() = default;

void PlacedInput::read_at(std::int64_t place, std::span<std::byte> into) const {
  while (!into.empty()) {
    const std::size_t got = file_ ? file_->read_at(place, into, path_)
                                  : kept_.copy(reinterpret_cast<char*>(into.data()), into.size(), place);
    if (got == 0) refuse_changed(path_);
    into = into.subspan(got);
    place += static_cast<std::int64_t>(got);
  }
}

void require_same_size(const Communicator& comm, const std::string& path, std::int64_t size) {
  if (comm.minimum(size) != comm.maximum(size))
    throw InputError(path +
                     ": has not the same size on all machines; another program may still be writing it, or "
                     "the machines have different files of this name");
}

void allow_piped_input(bool allowed) { pipes_allowed = allowed; }

}  // namespace quadloop::io
