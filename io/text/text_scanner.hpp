#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/text/tokens.hpp"

namespace quadloop::io {

/// Reads blank-separated tokens of a text in memory, and skips comments (from a `comment` character at the
/// beginning of a token to the end of its line). Errors are InputErrors "file:line: ...".
class TextScanner {
 public:
  static constexpr char no_comments = '\n';

  /// Reads the file; InputError if it cannot be read.
  explicit TextScanner(std::string path, char comment = '#');
  /// Takes a text that was read from it.
  TextScanner(std::string path, std::string text, char comment);

  /// Whether only blanks and comments remain.
  bool at_end();
  /// Returns the next token; if there is none, the error names what was expected.
  std::string_view token(std::string_view expected);
  std::int64_t integer(std::string_view expected);
  /// A finite number, also with a Fortran exponent (1.0D-3).
  double real(std::string_view expected);
  /// Reads a number of rows of `width` tokens each, and checks that the rest of the file can contain them, so
  /// that a wrong number does not cause a huge allocation. `of` names the rows.
  std::size_t count(const std::string& of, std::size_t width);
  std::size_t bytes_left() const { return end_ - at_; }

  /// Whether only blanks and a comment remain on this line; stays on the line.
  bool at_line_end();
  /// Returns the rest of this line, without surrounding blanks and without a comment.
  std::string_view rest_of_line();

  /// Places are offsets in the whole text. place() is the start of the last token.
  std::string_view text() const { return text_; }
  std::size_t place() const { return token_ - text_.data(); }
  void go_to(std::size_t place) { at_ = token_ = comments_begin_ = text_.data() + place; }

  /// Returns the last skipped comment that contains `text`, since the last forget_comments(); empty if there
  /// is none.
  std::string_view last_comment_with(std::string_view text) const;
  /// Returns all text skipped since then: only comments, if no token was read.
  std::string_view passed_over() const { return {comments_begin_, at_}; }
  void forget_comments() { comments_begin_ = at_; }

  /// Throws with the line of the last token.
  [[noreturn]] void refuse(const std::string& message) const { refuse_at(place(), message); }
  [[noreturn]] void refuse_at(std::size_t place, const std::string& message) const;
  const std::string& path() const { return path_; }
  /// Returns "file:line" of a place.
  std::string place_text(std::size_t place) const;

 private:
  void skip();

  std::string path_, text_;
  char comment_;
  const char* at_ = nullptr;
  const char* end_ = nullptr;
  const char* token_ = nullptr;           ///< start of the last token
  const char* comments_begin_ = nullptr;  ///< start of the range up to at_ that is searched for comments
};

}  // namespace quadloop::io
