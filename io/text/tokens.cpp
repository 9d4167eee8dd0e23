#include "io/text/tokens.hpp"

#include <locale.h>

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "io/text/decimal_comma.hpp"

namespace quadloop::io {

namespace {

constexpr std::size_t longest_quote = 40;  // of an invalid token, in a message

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

std::string unexpected(std::string_view token, std::string_view expected) {
  return "expected " + std::string(expected) + ", found \"" + std::string(token.substr(0, longest_quote)) +
         "\"";
}

}  // namespace

const char* next_token(const char* at, const char* end, char comment) {
  while (at != end) {
    if (is_space(*at)) {
      ++at;
    } else if (*at == comment) {
      at = end_of_line(at, end);
    } else {
      break;
    }
  }
  return at;
}

bool parse_integer(std::string_view token, std::int64_t& value) {
  const char* const end = token.data() + token.size();
  const auto [stopped, error] = std::from_chars(token.data(), end, value);
  return error == std::errc{} && stopped == end;
}

bool parse_real(std::string_view token, double& value) {
  return parse_c_real(token, value) || parse_c_real(with_c_exponent(token), value);
}

std::string why_no_integer(std::string_view token, std::string_view expected) {
  return unexpected(token, expected);
}

std::string why_no_finite_real(std::string_view token, std::string_view expected) {
  double value = 0;
  if (parse_real(token, value))
    return std::string(expected) + " is not finite: " + std::string(token.substr(0, longest_quote));
  const std::string comma = decimal_comma_in(token);
  return unexpected(token, expected) + (comma.empty() ? "" : "; " + comma);
}

std::string why_no_count(std::int64_t count, const std::string& of, std::size_t width, std::size_t bytes_left,
                         int ranks) {
  if (count < 0) return "the number of " + of + " is negative: " + std::to_string(count);
  if (count / ranks > std::numeric_limits<std::int32_t>::max())
    return "more than 2^31 - 1 " + of + " cannot be read on one rank";
  if (2 * width * static_cast<std::size_t>(count) > bytes_left + 1)
    return "the file ends before its " + std::to_string(count) + " " + of +
           " can follow; it is cut short, or this count is wrong";
  return {};
}

std::string_view last_comment_with(std::string_view text, std::string_view passed, char comment) {
  for (std::size_t hash = passed.rfind(comment); hash != std::string_view::npos;
       hash = passed.rfind(comment, hash - 1)) {
    const std::string_view line = passed.substr(hash, passed.find_first_of("\r\n", hash) - hash);
    if (line.find(text) != std::string_view::npos) return line;
    if (hash == 0) break;
  }
  return {};
}

}  // namespace quadloop::io
