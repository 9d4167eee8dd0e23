#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace quadloop::io {

/// Whether a character separates tokens.
inline bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// Returns the beginning of the first token at or after `at`, or `end`: skips blanks, and comments from a
/// `comment` character at the beginning of a token to the end of its line.
const char* next_token(const char* at, const char* end, char comment);

/// Returns the end of the token that begins at `at`.
inline const char* end_of_token(const char* at, const char* end) {
  while (at != end && !is_space(*at)) ++at;
  return at;
}

/// Whether a token is a whole number.
bool parse_integer(std::string_view token, std::int64_t& value);

/// Whether a token is a number as a whole, also with a Fortran exponent (1.0D-3), in any locale; includes
/// "nan" and "inf". Values outside the range of doubles become 0 or infinity.
bool parse_real(std::string_view token, double& value);

/// Return what is wrong with a token where a number was expected, of which `expected` is the name.
std::string why_no_integer(std::string_view token, std::string_view expected);
std::string why_no_finite_real(std::string_view token, std::string_view expected);

/// Returns why a number cannot be that of the rows, of `width` tokens each, that follow in the remaining
/// bytes of the file and are distributed to these ranks; empty if it can. So a wrong number does not cause a
/// huge allocation. `of` names the rows.
std::string why_no_count(std::int64_t count, const std::string& of, std::size_t width, std::size_t bytes_left,
                         int ranks = 1);

/// Returns the last comment in a text that contains `text`, up to the end of its line; empty if there is
/// none.
std::string_view last_comment_with(std::string_view text, std::string_view passed, char comment);

}  // namespace quadloop::io
