#include "io/text/text_scanner.hpp"

#include <locale.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <utility>

#include "io/files/reading/input_file.hpp"
#include "io/text/decimal_comma.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

constexpr std::size_t longest_quote = 40;  // of an invalid token, in a message

bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

const char* end_of_line(const char* at, const char* end) {
  const void* const found = std::memchr(at, '\n', end - at);
  return found == nullptr ? end : static_cast<const char*>(found);
}

/// Converts a Fortran exponent (1.0D-03) in a copy of this token.
std::string with_c_exponent(std::string_view token) {
  std::string copy(token);
  for (char& c : copy) {
    if (c == 'd' || c == 'D') c = 'e';
  }
  return copy;
}

/// Result of strtod() for a number outside the range of doubles, in any locale.
double nearest_double(const std::string& number) {
  static const locale_t c_locale = newlocale(LC_ALL_MASK, "C", nullptr);
  return strtod_l(number.c_str(), nullptr, c_locale);
}

/// As from_chars, but values that underflow are rounded, as in other programs.
bool parse_c_real(std::string_view token, double& value) {
  if (token.starts_with("+-")) return false;
  if (token.starts_with('+')) token.remove_prefix(1);
  const char* const end = token.data() + token.size();
  const auto [stopped, error] = std::from_chars(token.data(), end, value);
  if (stopped != end) return false;
  if (error == std::errc::result_out_of_range) value = nearest_double(std::string(token));
  return error != std::errc::invalid_argument;
}

}  // namespace

bool parse_real(std::string_view token, double& value) {
  return parse_c_real(token, value) || parse_c_real(with_c_exponent(token), value);
}

TextScanner::TextScanner(std::string path, char comment)
    : path_{std::move(path)}, text_{read_input(path_)}, comment_{comment} {
  at_ = token_ = comments_begin_ = text_.data();
  end_ = at_ + text_.size();
}

void TextScanner::skip() {
  while (at_ != end_) {
    if (is_blank(*at_)) {
      ++at_;
    } else if (*at_ == comment_) {
      at_ = end_of_line(at_, end_);
    } else {
      return;
    }
  }
}

bool TextScanner::at_end() {
  skip();
  return at_ == end_;
}

std::string_view TextScanner::token(std::string_view expected) {
  skip();
  token_ = at_;
  while (at_ != end_ && !is_blank(*at_)) ++at_;
  if (token_ == at_) refuse("the file ends where " + std::string(expected) + " should follow");
  return {token_, at_};
}

std::int64_t TextScanner::integer(std::string_view expected) {
  const std::string_view text = token(expected);
  std::int64_t value = 0;
  const auto [stopped, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stopped != text.data() + text.size()) {
    refuse("expected " + std::string(expected) + ", found \"" + std::string(text.substr(0, longest_quote)) +
           "\"");
  }
  return value;
}

double TextScanner::real(std::string_view expected) {
  const std::string_view text = token(expected);
  double value = 0;
  if (!parse_real(text, value)) {
    const std::string comma = decimal_comma_in(text);
    refuse("expected " + std::string(expected) + ", found \"" + std::string(text.substr(0, longest_quote)) +
           "\"" + (comma.empty() ? "" : "; " + comma));
  }
  if (!std::isfinite(value))
    refuse(std::string(expected) + " is not finite: " + std::string(text.substr(0, longest_quote)));
  return value;
}

std::size_t TextScanner::count(const std::string& of, std::size_t width) {
  const std::int64_t value = integer("the number of " + of);
  if (value < 0) refuse("the number of " + of + " is negative: " + std::to_string(value));
  const std::size_t rows = value;
  if (rows > std::numeric_limits<std::int32_t>::max())
    refuse("more than 2^31 - 1 " + of + " cannot be read on one rank");
  if (2 * width * rows > bytes_left() + 1) {
    refuse("the file ends before its " + std::to_string(rows) + " " + of +
           " can follow; it is cut short, or this count is wrong");
  }
  return rows;
}

bool TextScanner::at_line_end() {
  while (at_ != end_ && *at_ != '\n' && is_blank(*at_)) ++at_;
  return at_ == end_ || *at_ == '\n' || *at_ == comment_;
}

std::string_view TextScanner::rest_of_line() {
  if (at_line_end()) return {};
  token_ = at_;
  const char* last = at_;
  for (; at_ != end_ && *at_ != '\n'; ++at_) {
    if (is_blank(*at_)) continue;
    if (*at_ == comment_ && is_blank(at_[-1])) break;
    last = at_ + 1;
  }
  return {token_, last};
}

std::string_view TextScanner::last_comment_with(std::string_view text) const {
  const std::string_view passed(comments_begin_, at_);
  for (std::size_t hash = passed.rfind(comment_); hash != std::string_view::npos;
       hash = passed.rfind(comment_, hash - 1)) {
    const std::string_view comment = passed.substr(hash, passed.find_first_of("\r\n", hash) - hash);
    if (comment.find(text) != std::string_view::npos) return comment;
    if (hash == 0) break;
  }
  return {};
}

std::string TextScanner::place_text(std::size_t place) const {
  const auto line = 1 + std::count(text_.data(), text_.data() + place, '\n');
  return path_ + ":" + std::to_string(line);
}

void TextScanner::refuse_at(std::size_t place, const std::string& message) const {
  throw InputError(place_text(place) + ": " + message);
}

}  // namespace quadloop::io
