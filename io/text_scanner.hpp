#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace quadloop {

/// Reads blank-separated tokens of a text that is held whole, and passes over comments (from a '#' that begins a token to the
/// end of its line). Every refusal is an InputError "file:line: ...".
class TextScanner {
 public:
  /// Reads the file; InputError where it cannot be read.
  explicit TextScanner(std::string path);

  /// Whether only blanks and comments are left.
  bool at_end();
  /// The next token, or a refusal that says what was expected.
  std::string_view token(std::string_view expected);
  std::int64_t integer(std::string_view expected);
  /// A finite number, also with a Fortran exponent (1.0D-3).
  double real(std::string_view expected);
  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }

  /// The comment passed over last that contains `text`, since the last forget_comments(); empty where there was none.
  std::string_view last_comment_with(std::string_view text) const;
  void forget_comments() { comments_begin_ = at_; }

  /// Refuses with the line of the token read last.
  [[noreturn]] void refuse(const std::string& message) const;

 private:
  void skip();

  std::string path_, text_;
  const char* at_ = nullptr;
  const char* end_ = nullptr;
  const char* token_ = nullptr;           ///< where the last token begins
  const char* comments_begin_ = nullptr;  ///< comments are looked for between here and at_
};

}  // namespace quadloop
