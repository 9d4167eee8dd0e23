#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/reading/line_range.hpp"
#include "mesher/base/parallel/communicator.hpp"

namespace quadloop::io {

/// The blank-separated tokens of a text file that all ranks read, numbered over all ranks; comments are
/// skipped. Each rank has those of its lines. It passes over them once, to count them, and can then go to any
/// of them.
class RangeTokens {
 public:
  static constexpr char comment = '#';

  /// Throws InputError on all ranks. *Collective.*
  RangeTokens(const Communicator& comm, const std::string& path, std::size_t piece = LineRange::usual_piece);

  /// Numbers of this rank's tokens: begin() to end() - 1.
  std::int64_t begin() const { return begin_; }
  std::int64_t end() const { return end_; }
  std::int64_t file_size() const { return range_.file_size(); }

  /// Goes to the beginning of a token of this rank. A token that is near is reached fastest from one before
  /// it.
  void go_to(std::int64_t number);
  /// Returns the token and goes to the next one of this rank; there must be one. Valid until the next call.
  std::string_view next();
  /// Offset in the file of the token that next() will return, after go_to() or text_before().
  std::int64_t next_place() const { return pieces_[loaded_].place + (at_ - text_.data()); }
  /// Offset in the file of the token that next() returned, and of its end.
  std::int64_t place() const { return place_; }
  std::int64_t place_after() const { return place_ + length_; }

  /// Returns the text between the token `number - 1` and the next one, as far as it is on this rank, and goes
  /// to the latter. `number` may be end().
  std::string text_before(std::int64_t number);

  /// Returns the line, from 1, of a place on this rank, or of the end of the file on the last rank.
  std::int64_t line_of(std::int64_t place);

 private:
  /// What is before a piece of text.
  struct Piece {
    std::int64_t place, tokens, lines;
  };
  void count_pieces();
  void load(std::size_t piece);

  LineRange range_;
  std::vector<Piece> pieces_;
  std::int64_t begin_ = 0, end_ = 0, first_line_ = 1;
  std::size_t loaded_ = 0;     ///< piece, if text_ is not empty
  std::string_view text_;      ///< of it
  const char* at_ = nullptr;   ///< in it
  std::int64_t number_ = -1;   ///< of the next token
  bool behind_token_ = false;  ///< whether at_ is the end of the one before it
  std::int64_t place_ = 0, length_ = 0;
};

}  // namespace quadloop::io
