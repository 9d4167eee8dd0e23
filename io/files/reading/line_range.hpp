#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/files/reading/input_file.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::io {

/// One rank's lines of a text file that all ranks read: contiguous, in the order of ranks, about as many
/// bytes on each. A line belongs to the rank in whose range of bytes it begins. The lines are read piece by
/// piece, as often as required; none is kept. A pipe, which only a single rank may read, is kept in memory.
class LineRange {
 public:
  static constexpr std::size_t usual_piece = std::size_t{1} << 20;  ///< bytes

  /// Throws InputError on all ranks if one cannot read the file. *Collective.*
  LineRange(const Communicator& comm, const std::string& path, std::size_t piece = usual_piece);

  /// Places are offsets in the file.
  std::int64_t file_size() const { return size_; }
  std::int64_t begin() const { return begin_; }
  std::int64_t end() const { return end_; }

  /// Returns whole lines from a place at which a line of this rank begins: about as many bytes as a piece
  /// has, or a longer line; empty at end(). Valid until the next call. Throws InputError.
  std::string_view piece_at(std::int64_t place);

 private:
  void read(std::int64_t place, std::size_t bytes);
  std::int64_t first_line_from(std::int64_t place);

  std::optional<PlacedInput> file_;  ///< none if the text is kept
  std::string text_;                 ///< the piece, or all of a pipe
  std::size_t piece_;
  std::int64_t size_ = 0, begin_ = 0, end_ = 0;
};

}  // namespace quadloop::io
