#include "io/files/reading/value_pipe.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace quadloop::io {

namespace {

constexpr std::size_t room = std::size_t{1} << 16;  // bytes collected per system call

}  // namespace

PipeWriter::~PipeWriter() { ::close(descriptor_); }

void PipeWriter::bytes(const void* from, std::size_t size) {
  const char* const begin = static_cast<const char*>(from);
  if (waiting_.size() + size >= room) flush();
  if (size >= room) {
    write_out(begin, size);
  } else {
    waiting_.insert(waiting_.end(), begin, begin + size);
  }
}

void PipeWriter::flush() {
  write_out(waiting_.data(), waiting_.size());
  waiting_.clear();
}

void PipeWriter::write_out(const char* from, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(descriptor_, from, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return;
    from += written;
    size -= written;
  }
}

PipeReader::PipeReader(int descriptor) : descriptor_{descriptor}, room_(room) {}

PipeReader::~PipeReader() { ::close(descriptor_); }

void PipeReader::bytes(void* to, std::size_t size) {
  char* out = static_cast<char*>(to);
  while (size > 0) {
    if (begin_ < end_) {
      const std::size_t count = std::min(size, end_ - begin_);
      std::memcpy(out, room_.data() + begin_, count);
      begin_ += count;
      out += count;
      size -= count;
      continue;
    }
    const bool direct = size >= room;
    const ssize_t length = direct ? ::read(descriptor_, out, size) : ::read(descriptor_, room_.data(), room);
    if (length < 0 && errno == EINTR) continue;
    if (length <= 0) throw PipeEnded();
    if (direct) {
      out += length;
      size -= length;
    } else {
      begin_ = 0;
      end_ = length;
    }
  }
}

}  // namespace quadloop::io
