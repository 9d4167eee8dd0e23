#include "mesher/base/utf8.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace quadloop {

namespace {

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace

std::size_t utf8_length(std::string_view text) {
  const unsigned char first = text[0];
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xC2 && first < 0xE0 ? 2
                             : first >= 0xE0 && first < 0xF0 ? 3
                             : first >= 0xF0 && first < 0xF5 ? 4
                                                             : 0;
  if (length > text.size()) return 0;
  for (std::size_t k = 1; k < length; ++k) {
    if ((text[k] & 0xC0) != 0x80) return 0;
  }
  return length;
}

bool is_control_character(std::string_view character) {
  const unsigned char first = character[0];
  const bool second_set = first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0;
  return first < 0x20 || first == 0x7F || second_set;
}

std::string as_utf8(std::string_view text) {
  if (is_utf8(text)) return std::string(text);
  std::string result;
  for (const unsigned char byte : text) {
    if (byte < 0x80) {
      result += static_cast<char>(byte);
    } else {
      result += static_cast<char>(0xC0 | (byte >> 6U));
      result += static_cast<char>(0x80 | (byte & 0x3FU));
    }
  }
  return result;
}

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
    const bool breaks_text = text[0] == '\n' || text[0] == '\t';
    if (length == 0 || (!breaks_text && is_control_character(character))) {
      for (const unsigned char byte : character) result += fmt::format("\\x{:02x}", unsigned{byte});
    } else {
      result += character;
    }
    text.remove_prefix(character.size());
  }
  return result;
}

}  // namespace quadloop
