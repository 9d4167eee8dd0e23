#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/reading/input_file.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop::io {

/// Reads a text file row by row: comments (from a '#' to the end of its line) and blank lines are passed
/// over; LF, CRLF and CR are line ends; UTF-16 is read, with a byte order mark or without. Every refusal is
/// an InputError "file:line: what, what to do".
class LineReader {
 public:
  /// Opens the file, which is never stored completely; InputError if it cannot be read.
  explicit LineReader(const std::string& path);

  /// Goes to the next row; returns false at the end of the file.
  bool next();
  /// The same, but the end of the file is an error: `expected` is what is missing.
  void require_next(const std::string& expected);

  /// If the next row is two finite numbers and nothing else, in the usual notation, goes to it and returns
  /// them. Otherwise stays in place; next() then gives more detail.
  bool next_point(Point& point);
  /// Returns an upper bound of the number of such rows that can follow.
  std::size_t most_points_left() const;

  /// The row's words, split at blanks. Valid until the next row is read.
  const std::vector<std::string_view>& words() const { return words_; }
  /// The row, without comment.
  std::string_view row() const { return row_; }
  /// The row's number in the file, from 1.
  std::int64_t line() const { return line_; }
  std::string place() const { return path_ + ":" + std::to_string(line_); }

  /// Returns a word of the row as a finite number, with or without a Fortran exponent (1.0D-3), in any
  /// locale.
  double real(std::size_t word) const;
  std::int64_t count(std::size_t word, const std::string& of_what) const;
  /// Whether the word is a number of any kind.
  bool is_number(std::size_t word) const;

  [[noreturn]] void refuse(const std::string& message) const;

 private:
  /// Rejects a row of two coordinates with decimal commas, which could be taken for four words.
  void refuse_decimal_commas() const;

  /// Reads the whole file into text_.
  void read_rest();
  /// Reads the rest of the row at at_, or of the file, into text_.
  void fill();

  std::string path_;
  InputPieces file_;
  std::string text_;  ///< the part of the file in memory
  bool all_read_ = false;
  std::size_t at_ = 0, row_end_ = 0;
  std::int64_t line_ = 0;
  std::string_view row_;
  std::vector<std::string_view> words_;
};

}  // namespace quadloop::io
