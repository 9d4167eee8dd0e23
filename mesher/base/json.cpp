#include "mesher/base/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace quadloop {

namespace {

/// Bytes of the UTF-8 character that `text` begins with; 0 where it is none.
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

}  // namespace

std::string json_of(std::string_view text) {
  std::string quoted = "\"";
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    const unsigned char byte = text[0];
    if (byte == '"' || byte == '\\') {
      quoted += fmt::format("\\{}", text[0]);
    } else if (byte < 0x20 || length == 0) {
      quoted += fmt::format("\\u{:04x}", unsigned{byte});
    } else {
      quoted += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return quoted + "\"";
}

std::string json_of(double value) { return std::isfinite(value) ? fmt::format("{}", value) : "null"; }

std::string json_list(const std::vector<std::string>& values) {
  return fmt::format("[{}]", fmt::join(values, ", "));
}

std::string JsonObject::text() const { return fmt::format("{{{}}}", fmt::join(members_, ", ")); }

std::string JsonObject::lines(const std::string& indent) const {
  const std::string inner = "\n" + indent + "  ";
  return members_.empty() ? "{\n" + indent + "}"
                          : fmt::format("{{{}{}\n{}}}", inner, fmt::join(members_, "," + inner), indent);
}

}  // namespace quadloop
