#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace quadloop {

/// Bytes of the UTF-8 character that a text, not empty, begins with; 0 where it is none.
std::size_t utf8_length(std::string_view text);

/// Whether a character of UTF-8 is one of the control characters, ASCII or those from 0x80 on (ISO 6429).
bool is_control_character(std::string_view character);

/// A text in UTF-8 as it is; any other is taken as Latin-1, as old programs write it.
std::string as_utf8(std::string_view text);

/// The text for a terminal: control characters but line ends and tabs, and bytes that are no UTF-8, as
/// "\x1b".
std::string printable(std::string_view text);

}  // namespace quadloop
