#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "io/files/output_file.hpp"

namespace quadloop::io {

/// Converts a number to the byte order `order`.
template <std::endian order, class Number>
Number in_order(Number value) {
  if constexpr (order == std::endian::native) return value;
  auto bytes = std::bit_cast<std::array<std::byte, sizeof(Number)>>(value);
  std::ranges::reverse(bytes);
  return std::bit_cast<Number>(bytes);
}
template <std::endian order, class Number, std::size_t width>
std::array<Number, width> in_order(std::array<Number, width> values) {
  for (Number& value : values) value = in_order<order>(value);
  return values;
}

template <class T, std::size_t extent>
std::string_view bytes_of(std::span<const T, extent> rows) {
  return {reinterpret_cast<const char*>(rows.data()), rows.size_bytes()};
}

}  // namespace quadloop::io
