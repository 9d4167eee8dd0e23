#pragma once

#include <charconv>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/output_file.hpp"
#include "io/row_stream.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Grows a text number by number into room that was made once. Numbers are the shortest that read back as they are.
class TextRows {
 public:
  static constexpr std::size_t longest_number = 25;  // with the blank or line end after it: -1.7976931348623157e+308

  TextRows(std::int64_t rows, std::size_t width) : text_(static_cast<std::size_t>(rows) * width * longest_number) {}

  template <class Number>
  void put(Number value, char after) {
    char* const begin = text_.data() + used_;
    char* const end = std::to_chars(begin, begin + longest_number, value).ptr;
    *end = after;
    used_ += static_cast<std::size_t>(end - begin) + 1;
  }
  std::vector<char> take() {
    text_.resize(used_);
    return std::move(text_);
  }

 private:
  std::vector<char> text_;
  std::size_t used_ = 0;
};

/// A text file that all ranks write together, through rank 0; the file under way exists there alone. *Collective*, all of it.
class TextOutput {
 public:
  TextOutput(OutputSet& outputs, const std::string& path);

  const Communicator& communicator() const { return comm_; }

  /// Rank 0's text.
  void write(const std::string& text);

  /// The ranks' rows in the order of ranks, in bounded pieces: `put(text, i)` puts at most `width` numbers for this rank's row i.
  template <class Put>
  void write_rows(std::size_t rows, std::size_t width, const Put& put) {
    const RowStream stream{comm_, static_cast<std::int64_t>(rows), rows_per_piece};
    stream.run<char>(
        [&](std::int64_t begin, std::int64_t end) {
          TextRows text(end - begin, width);
          for (std::int64_t i = begin; i < end; ++i) put(text, static_cast<std::size_t>(i));
          return text.take();
        },
        [&](std::span<const char> text) {
          file_->write({text.data(), text.size()});
        });
  }

  void close();

 private:
  static constexpr std::int64_t rows_per_piece = std::int64_t{1} << 16;

  const Communicator& comm_;
  std::unique_ptr<OutputFile> file_;
};

/// The boundaries that have edges on any rank, in their order. *Collective.*
std::vector<const BoundaryEdges*> boundaries_with_edges(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop
