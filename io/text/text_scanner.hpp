#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace quadloop {

/// Whether a token is one number from end to end, also with a Fortran exponent (1.0D-3), the same in every
/// locale; "nan" and "inf" are. What a double cannot hold becomes the nearest: 0 or infinity.
bool parse_real(std::string_view token, double& value);

/// Reads blank-separated tokens of a text that is held whole, and passes over comments (from a `comment` that
/// begins a token to the end of its line). Every refusal is an InputError "file:line: ...".
class TextScanner {
 public:
  static constexpr char no_comments = '\n';

  /// Reads the file; InputError where it cannot be read.
  explicit TextScanner(std::string path, char comment = '#');

  /// Whether only blanks and comments are left.
  bool at_end();
  /// The next token, or a refusal that says what was expected.
  std::string_view token(std::string_view expected);
  std::int64_t integer(std::string_view expected);
  /// A finite number, also with a Fortran exponent (1.0D-3).
  double real(std::string_view expected);
  /// A number of rows of `width` tokens each, checked against what the file can still hold, so that a wrong
  /// one is not taken as a size of memory. `of` names the rows.
  std::size_t count(const std::string& of, std::size_t width);
  std::size_t bytes_left() const { return end_ - at_; }

  /// Whether only blanks and a comment are left on this line; the line is not left.
  bool at_line_end();
  /// What is left of this line, without the blanks around it and without a comment.
  std::string_view rest_of_line();

  /// Places are offsets in the whole text. place() is where the token read last begins.
  std::string_view text() const { return text_; }
  std::size_t place() const { return token_ - text_.data(); }
  void go_to(std::size_t place) { at_ = token_ = comments_begin_ = text_.data() + place; }

  /// The comment passed over last that contains `text`, since the last forget_comments(); empty where there
  /// was none.
  std::string_view last_comment_with(std::string_view text) const;
  /// All that was passed over since then: comments alone, if no token was read.
  std::string_view passed_over() const { return {comments_begin_, at_}; }
  void forget_comments() { comments_begin_ = at_; }

  /// Refuses with the line of the token read last.
  [[noreturn]] void refuse(const std::string& message) const { refuse_at(place(), message); }
  [[noreturn]] void refuse_at(std::size_t place, const std::string& message) const;
  const std::string& path() const { return path_; }
  /// "file:line" of a place.
  std::string place_text(std::size_t place) const;

 private:
  void skip();

  std::string path_, text_;
  char comment_;
  const char* at_ = nullptr;
  const char* end_ = nullptr;
  const char* token_ = nullptr;           ///< where the last token begins
  const char* comments_begin_ = nullptr;  ///< comments are looked for between here and at_
};

}  // namespace quadloop
