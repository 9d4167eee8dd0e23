#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>

#include "io/step/part21.hpp"

namespace quadloop::io {

namespace {

constexpr std::uint32_t replacement = 0xfffd;

void append_utf8(std::string& text, std::uint32_t code) {
  const auto part = [&](int shift) { return static_cast<char>(0x80 | ((code >> shift) & 0x3f)); };
  if (code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) code = replacement;
  if (code < 0x80) {
    text += static_cast<char>(code);
  } else if (code < 0x800) {
    text += {static_cast<char>(0xc0 | (code >> 6)), part(0)};
  } else if (code < 0x10000) {
    text += {static_cast<char>(0xe0 | (code >> 12)), part(6), part(0)};
  } else {
    text += {static_cast<char>(0xf0 | (code >> 18)), part(12), part(6), part(0)};
  }
}

/// The hexadecimal number of `digits` digits at the beginning of a text.
std::optional<std::uint32_t> hexadecimal(std::string_view text, std::size_t digits) {
  std::uint32_t number = 0;
  if (text.size() < digits) return std::nullopt;
  const auto [end, error] = std::from_chars(text.data(), text.data() + digits, number, 16);
  return error == std::errc() && end == text.data() + digits ? std::optional(number) : std::nullopt;
}

/// Appends the characters of \X2\...\X0\ (UTF-16) or \X4\...\X0\ (UTF-32) behind its first four bytes;
/// returns the number of bytes read.
std::size_t append_wide(std::string& text, std::string_view written, std::size_t digits) {
  std::size_t at = 0;
  std::uint32_t high = 0;
  while (const auto code = hexadecimal(written.substr(at), digits)) {
    at += digits;
    const bool is_low = *code >= 0xdc00 && *code < 0xe000;
    if (high != 0)
      append_utf8(text, is_low ? 0x10000 + ((high - 0xd800) << 10) + (*code - 0xdc00) : replacement);
    const bool is_used = high != 0 && is_low;
    high = digits == 4 && *code >= 0xd800 && *code < 0xdc00 ? *code : 0;
    if (!is_used && high == 0) append_utf8(text, *code);
  }
  if (high != 0) append_utf8(text, replacement);
  return written.substr(at).starts_with("\\X0\\") ? at + 4 : at;
}

/// Appends what a control directive that begins with a backslash stands for; returns its number of bytes.
std::size_t append_directive(std::string& text, std::string_view written) {
  const auto code = hexadecimal(written.substr(std::min<std::size_t>(3, written.size())), 2);
  if (written.starts_with("\\\\")) return text += '\\', 2;
  if (written.starts_with("\\X2\\")) return 4 + append_wide(text, written.substr(4), 4);
  if (written.starts_with("\\X4\\")) return 4 + append_wide(text, written.substr(4), 8);
  if (written.starts_with("\\X\\") && code) return append_utf8(text, *code), 5;
  if (written.starts_with("\\S\\") && written.size() > 3)
    return append_utf8(text, 0x80 + (static_cast<unsigned char>(written[3]) & 0x7fu)), 4;
  if (written.starts_with("\\N\\") || written.starts_with("\\F\\")) return text += ' ', 3;
  if (written.size() > 3 && written[1] == 'P' && written[3] == '\\')
    return 4;  // the alphabet of \S\ (Latin-1)
  return text += '\\', 1;
}

}  // namespace

std::string text_of_part21(std::string_view written) {
  std::string text;
  for (std::size_t at = 0; at < written.size();) {
    const char c = written[at];
    if (c == '\\') {
      at += append_directive(text, written.substr(at));
      continue;
    }
    if (c != '\n' && c != '\r') text += c;
    at += written.substr(at).starts_with("''") ? 2 : 1;
  }
  return text;
}

}  // namespace quadloop::io
