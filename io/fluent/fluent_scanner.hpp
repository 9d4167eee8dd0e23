#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "io/text/text_scanner.hpp"

namespace quadloop {

/// The tokens of a Fluent file: "(", ")", words, numbers, and texts in quotes with their quotes. Refusals are
/// InputErrors "file:line: ...".
class FluentScanner {
 public:
  explicit FluentScanner(const std::string& path) : scan_{path, TextScanner::no_comments} {}

  const TextScanner& scan() const { return scan_; }
  std::size_t place() const { return token_; }  ///< of the token read last
  std::size_t bytes_left() const { return scan_.text().size() - at_; }

  bool at_end();
  std::string_view token(std::string_view expected);
  /// The next token without taking it; empty at the end.
  std::string_view peek();
  bool is_number_next();
  void expect(std::string_view sign);
  std::int64_t hexadecimal(std::string_view expected) { return integer(expected, 16); }
  std::int64_t decimal(std::string_view expected) { return integer(expected, 10); }
  double real(std::string_view expected);
  /// Goes behind the ")" that ends the list of which a "(" was taken last.
  void skip_list();

  [[noreturn]] void refuse(const std::string& message) const { scan_.refuse_at(token_, message); }

 private:
  std::int64_t integer(std::string_view expected, int base);

  TextScanner scan_;
  std::size_t at_ = 0, token_ = 0;
};

}  // namespace quadloop
