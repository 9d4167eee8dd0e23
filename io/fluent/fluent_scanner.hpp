#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/text/text_scanner.hpp"

namespace quadloop::io {

/// Tokens of a Fluent file: "(", ")", words, numbers, and quoted strings with their quotes. Errors are
/// InputErrors "file:line: ...".
class FluentScanner {
 public:
  explicit FluentScanner(const std::string& path) : scan_{path, TextScanner::no_comments} {}

  const TextScanner& scan() const { return scan_; }
  std::size_t place() const { return token_; }  ///< of the last token
  std::size_t bytes_left() const { return scan_.text().size() - at_; }

  bool at_end();
  std::string_view token(std::string_view expected);
  /// Returns the next token without consuming it; empty at the end.
  std::string_view peek();
  bool is_number_next();
  void expect(std::string_view sign);
  std::int64_t hexadecimal(std::string_view expected) { return integer(expected, 16); }
  std::int64_t decimal(std::string_view expected) { return integer(expected, 10); }
  double real(std::string_view expected);
  /// Skips to after the ")" that matches the last consumed "(".
  void skip_list();

  [[noreturn]] void refuse(const std::string& message) const { scan_.refuse_at(token_, message); }

 private:
  std::int64_t integer(std::string_view expected, int base);

  TextScanner scan_;
  std::size_t at_ = 0, token_ = 0;
};

}  // namespace quadloop::io
