#include "mesher/base/json.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesher/base/utf8.hpp"

namespace quadloop {

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
