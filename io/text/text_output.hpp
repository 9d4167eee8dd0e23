#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/files/boundary_stream.hpp"
#include "io/files/output_file.hpp"
#include "io/files/row_stream.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::io {

/// Appends numbers to a text in preallocated memory. Numbers are the shortest that read back bitwise.
class TextRows {
 public:
  static constexpr std::size_t longest_number =
      25;  // including a blank or line end: -1.7976931348623157e+308

  TextRows(std::int64_t rows, std::size_t width) : text_(rows * width * longest_number) {}

  template <class Number>
  void put(Number value) {
    char* const begin = text_.data() + used_;
    used_ += std::to_chars(begin, begin + longest_number, value).ptr - begin;
  }
  template <class Number>
  void put(Number value, char after) {
    put(value);
    text_[used_++] = after;
  }
  void put_hexadecimal(std::int64_t value, char after) {
    char* const begin = text_.data() + used_;
    char* const end = std::to_chars(begin, begin + longest_number, value, 16).ptr;
    *end = after;
    used_ += end - begin + 1;
  }
  /// Appends one character, e.g. after a number without one; the reserved numbers must leave space for it.
  void mark(char sign) { text_[used_++] = sign; }
  std::vector<char> take() {
    text_.resize(used_);
    return std::move(text_);
  }

 private:
  std::vector<char> text_;
  std::size_t used_ = 0;
};

/// A text file that all ranks write together, through rank 0, where it is stored until committed. All
/// functions are *collective*.
class TextOutput {
 public:
  TextOutput(OutputSet& outputs, const std::string& path);
  /// For a file that is already staged.
  TextOutput(const Communicator& comm, const StagedFile& staged);

  const Communicator& communicator() const { return comm_; }

  /// Writes rank 0's text.
  void write(const std::string& text);

  /// Writes the rows of all ranks in the order of ranks, in bounded pieces: `put(text, i)` appends at most
  /// `width` numbers for this rank's row i.
  template <class Put>
  void write_rows(std::int64_t rows, std::size_t width, const Put& put) {
    const RowStream stream{comm_, rows, rows_per_piece(width)};
    stream.run<char>(
        [&](std::int64_t begin, std::int64_t end) {
          TextRows text(end - begin, width);
          for (std::int64_t i = begin; i < end; ++i) put(text, i);
          return text.take();
        },
        [&](std::span<const char> text) {
          file_->write({text.data(), text.size()});
        });
  }

  /// Writes rows from rank 0 only.
  template <class Put>
  void write_root_rows(std::int64_t rows, std::size_t width, const Put& put) {
    write_rows(comm_.is_root() ? rows : 0, width, put);
  }

  /// Writes the edges of all boundaries: `head(n)` is the text before those of present()[n], `put(text, n,
  /// edge)` appends at most `width` numbers for one.
  template <class Head, class Put>
  void write_boundaries(const BoundaryStream& boundaries, std::size_t width, const Head& head,
                        const Put& put) {
    const std::int64_t most = rows_per_piece(width);
    std::size_t under_way = 0;
    std::string waiting;  // combines the writes of boundaries with few edges
    boundaries.run(
        [&](std::size_t n) {
          under_way = n;
          waiting += head(n);
        },
        [&](std::span<const BoundaryStream::Edge> edges) {
          for (; !edges.empty(); edges = edges.subspan(std::min<std::size_t>(edges.size(), most))) {
            const auto some = edges.first(std::min<std::size_t>(edges.size(), most));
            TextRows rows(std::ssize(some), width);
            for (const BoundaryStream::Edge& edge : some) put(rows, under_way, edge);
            const std::vector<char> text = rows.take();
            waiting.append(text.begin(), text.end());
            if (waiting.size() < largest_wait) continue;
            file_->write(waiting);
            waiting.clear();
          }
        });
    write(waiting);
  }

  void close();

 private:
  static std::int64_t rows_per_piece(std::size_t width) {
    return std::max<std::int64_t>(1, numbers_per_piece / static_cast<std::int64_t>(width));
  }

  static constexpr std::int64_t numbers_per_piece = std::int64_t{1} << 17;  // at most 3.3 MB of text
  static constexpr std::size_t largest_wait = std::size_t{1} << 20;         // bytes

  const Communicator& comm_;
  std::unique_ptr<OutputFile> file_;
};

}  // namespace quadloop::io
