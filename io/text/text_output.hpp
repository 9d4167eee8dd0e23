#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/files/boundary_stream.hpp"
#include "io/files/output_file.hpp"
#include "io/files/row_output.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::io {

/// Appends numbers to a text in preallocated memory. Numbers are the shortest that read back bitwise.
class TextRows {
 public:
  static constexpr std::size_t longest_number =
      25;  // including a blank or line end: -1.7976931348623157e+308

  TextRows() = default;
  TextRows(std::int64_t rows, std::size_t width) { clear(rows, width); }

  /// Begins a text of `rows` rows, each of at most `width` numbers.
  void clear(std::int64_t rows, std::size_t width) {
    text_.resize(std::max(text_.size(), rows * width * longest_number));
    used_ = 0;
  }

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
  std::string_view view() const { return {text_.data(), used_}; }
  std::vector<char> take() {
    text_.resize(used_);
    return std::move(text_);
  }

 private:
  std::vector<char> text_;
  std::size_t used_ = 0;
};

/// A text file that all ranks write together, each its own rows. All functions are *collective*.
class TextOutput {
 public:
  TextOutput(OutputSet& outputs, const std::string& path) : TextOutput(outputs, outputs.stage(path)) {}
  /// For a file that is already staged.
  TextOutput(OutputSet& outputs, const StagedFile& staged) : file_{outputs, staged} {}

  const Communicator& communicator() const { return file_.communicator(); }

  /// Writes rank 0's text.
  void write(const std::string& text) { file_.write(text); }

  /// Writes the rows of all ranks in the order of ranks, in bounded pieces: `put(text, i)` appends at most
  /// `width` numbers for this rank's row i. It may be called twice for a row.
  template <class Put>
  void write_rows(std::int64_t rows, std::size_t width, const Put& put) {
    write_sections({{rows}}, width, [&](TextRows& text, std::size_t, std::int64_t i) { put(text, i); });
  }

  /// Writes rows from rank 0 only.
  template <class Put>
  void write_root_rows(std::int64_t rows, std::size_t width, const Put& put) {
    write_rows(communicator().is_root() ? rows : 0, width, put);
  }

  /// Writes the edges of all boundaries: `head(n)` is the text before those of present()[n], used on rank 0;
  /// `put(text, n, edge)` appends at most `width` numbers for one. It may be called twice for an edge.
  template <class Head, class Put>
  void write_boundaries(const BoundaryStream& boundaries, std::size_t width, const Head& head,
                        const Put& put) {
    RowSections sections{boundaries.own_rows()};
    for (std::size_t n = 0; communicator().is_root() && n < sections.rows.size(); ++n)
      sections.heads.push_back(head(n));
    write_sections(std::move(sections), width, [&](TextRows& text, std::size_t n, std::int64_t i) {
      put(text, n, boundaries.own_edge(n, i));
    });
  }

  /// Writes sections, each after its head, and of each the rows of all ranks in the order of ranks:
  /// `put(text, section, i)` appends at most `width` numbers. It may be called twice for a row.
  template <class Put>
  void write_sections(RowSections sections, std::size_t width, const Put& put) {
    sections.rows_per_piece = std::max<std::int64_t>(1, numbers_per_piece / static_cast<std::int64_t>(width));
    file_.write_sections(std::move(sections), [&](std::size_t n, std::int64_t begin, std::int64_t end) {
      text_.clear(end - begin, width);
      for (std::int64_t i = begin; i < end; ++i) put(text_, n, i);
      return text_.view();
    });
  }

  void close() { file_.close(); }

 private:
  static constexpr std::int64_t numbers_per_piece = std::int64_t{1} << 17;  // at most 3.3 MB of text

  RowOutput file_;
  TextRows text_;
};

}  // namespace quadloop::io
