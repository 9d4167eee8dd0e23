#include "io/text/decimal_comma.hpp"

#include <cctype>
#include <charconv>

namespace quadloop::io {

std::string decimal_comma_in(std::string_view word) {
  const std::size_t comma = word.find(',');
  const auto is_digit = [&](std::size_t i) {
    return i < word.size() && std::isdigit(static_cast<unsigned char>(word[i])) != 0;
  };
  if (comma == std::string_view::npos || comma == 0 || !is_digit(comma - 1) || !is_digit(comma + 1))
    return {};
  std::string number(word);
  number[comma] = '.';
  std::string plain = number.substr(number.front() == '+' ? 1 : 0);
  for (char& c : plain) c = c == 'd' || c == 'D' ? 'e' : c;
  double value = 0;
  const char* const end = plain.data() + plain.size();
  if (std::from_chars(plain.data(), end, value).ptr != end) return {};
  return std::string(word) + ": a decimal comma; write " + number;
}

}  // namespace quadloop::io
