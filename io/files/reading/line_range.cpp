#include "io/files/reading/line_range.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "mesher/base/error.hpp"
#include "mesher/base/parallel/even_shares.hpp"

namespace quadloop::io {

namespace {

bool is_pipe(const std::string& path) {
  std::error_code failure;
  return std::filesystem::is_fifo(path, failure);
}

}  // namespace

LineRange::LineRange(const Communicator& comm, const std::string& path, std::size_t piece) : piece_{piece} {
  comm.together([&] {
    if (comm.size() == 1 && is_pipe(path)) {
      text_ = read_input(path);
      size_ = std::ssize(text_);
      return;
    }
    file_.emplace(path);
    size_ = file_->size();
  });
  require_same_size(comm, path, size_);
  comm.together([&] {
    if (file_) begin_ = first_line_from(even_begin(size_, comm.rank(), comm.size()));
  });
  std::vector<std::int64_t> begins = comm.all_gather(begin_);
  begins.push_back(size_);
  end_ = begins[comm.rank() + 1];
}

void LineRange::read(std::int64_t place, std::size_t bytes) {
  const std::size_t before = text_.size();
  text_.resize(before + bytes);
  file_->read_at(place, std::as_writable_bytes(std::span(text_).subspan(before)));
}

/// Returns the place of the first line that begins at `place` or behind it.
std::int64_t LineRange::first_line_from(std::int64_t place) {
  if (place == 0) return 0;
  for (std::int64_t at = place - 1; at < size_;) {
    const std::int64_t bytes = std::min<std::int64_t>(piece_, size_ - at);
    text_.clear();
    read(at, bytes);
    const std::size_t found = text_.find('\n');
    if (found != std::string::npos) return at + static_cast<std::int64_t>(found) + 1;
    at += bytes;
  }
  return size_;
}

std::string_view LineRange::piece_at(std::int64_t place) {
  if (!file_) return std::string_view(text_).substr(place);
  text_.clear();
  while (true) {
    const std::int64_t at = place + std::ssize(text_);
    const std::size_t before = text_.size();
    read(at, std::min<std::int64_t>(piece_, end_ - at));
    if (place + std::ssize(text_) == end_) return text_;
    const std::size_t last = text_.rfind('\n');
    if (last != std::string::npos && last >= before) return std::string_view(text_).substr(0, last + 1);
  }
}

}  // namespace quadloop::io
