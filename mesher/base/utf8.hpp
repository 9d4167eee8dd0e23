#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace quadloop {

/// Returns the number of bytes of the first UTF-8 character of a non-empty text; 0 if it is not valid.
std::size_t utf8_length(std::string_view text);

/// Whether a UTF-8 character is a control character, ASCII or from 0x80 on (ISO 6429).
bool is_control_character(std::string_view character);

/// Returns a UTF-8 text unchanged; any other is taken as Latin-1, which old programs write.
std::string as_utf8(std::string_view text);

/// Returns the text for a terminal: control characters other than newlines and tabs, and bytes that are not
/// UTF-8, become "\x1b".
std::string printable(std::string_view text);

}  // namespace quadloop
