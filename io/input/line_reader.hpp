#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/files/reading/input_file.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

/// Reads a text file row by row: comments (from a '#' to the end of its line) and blank lines are passed
/// over; LF, CRLF and CR are line ends; UTF-16 is read where a byte order mark tells it. Every refusal is an
/// InputError "file:line: what, what to do".
class LineReader {
 public:
  /// Opens the file, which is never held whole; InputError where it cannot be read.
  explicit LineReader(const std::string& path);

  /// Goes to the next row; false at the end of the file.
  bool next();
  /// The same, but the file may not end here: `expected` says what is missing.
  void require_next(const std::string& expected);

  /// Goes to the next row where that is two finite numbers and nothing else, written as most programs do, and
  /// gives them. Otherwise stays where it is, and next() tells more.
  bool next_point(Point& point);
  /// No fewer than the rows of that kind that can follow.
  std::size_t most_points_left() const;

  /// The row's words, split at blanks. Valid until the next row is read.
  const std::vector<std::string_view>& words() const { return words_; }
  /// The row as it stands, without comment.
  std::string_view row() const { return row_; }
  /// The row's number in the file, from 1 on.
  std::int64_t line() const { return line_; }
  std::string place() const { return path_ + ":" + std::to_string(line_); }

  /// A word of the row as a finite number, with or without a Fortran exponent (1.0D-3), the same in every
  /// locale.
  double real(std::size_t word) const;
  std::int64_t count(std::size_t word, const std::string& of_what) const;
  /// Whether the word is a number of any kind.
  bool is_number(std::size_t word) const;

  [[noreturn]] void refuse(const std::string& message) const;

 private:
  /// A row of two coordinates, each with a decimal comma, must not pass for four words.
  void refuse_decimal_commas() const;

  /// Makes text_ hold the whole file.
  void read_rest();
  /// Makes text_ hold the rest of the row at at_, or of the file.
  void fill();

  std::string path_;
  InputPieces file_;
  std::string text_;  ///< what is held of the file
  bool all_read_ = false;
  std::size_t at_ = 0, row_end_ = 0;
  std::int64_t line_ = 0;
  std::string_view row_;
  std::vector<std::string_view> words_;
};

}  // namespace quadloop
