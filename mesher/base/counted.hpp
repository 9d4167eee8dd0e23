#pragma once

#include <cstdint>
#include <string>

namespace quadloop {

/// Returns a number with its noun, for messages: "1 face", "3 faces". The noun gets an "s" in the plural.
inline std::string counted(std::int64_t number, const std::string& noun) {
  return std::to_string(number) + " " + noun + (number == 1 ? "" : "s");
}

}  // namespace quadloop
