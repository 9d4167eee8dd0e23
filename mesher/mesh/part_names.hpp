#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

namespace quadloop {

/// Returns the name of a partition, and of the boundary between it and another: "part_0003" for partition 2,
/// with at least four digits.
inline std::string part_name(std::int32_t part) {
  constexpr std::size_t digits = 4;
  const std::string number = std::to_string(part + 1);
  return "part_" + std::string(digits - std::min(digits, number.size()), '0') + number;
}

/// Whether a boundary has the name of edges between two partitions.
inline bool is_part_name(std::string_view name) {
  constexpr std::string_view head = "part_";
  return name.starts_with(head) && name.size() > head.size() &&
         name.find_first_not_of("0123456789", head.size()) == std::string_view::npos;
}

}  // namespace quadloop
