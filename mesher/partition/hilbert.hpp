#pragma once

#include <cstdint>
#include <utility>

namespace quadloop {

/// Bits of each coordinate of a square.
constexpr int hilbert_bits = 31;

/// Returns the key of a square on the Hilbert curve (Hilbert 1891) through 2^31 x 2^31 squares: squares with
/// consecutive keys share a side.
constexpr std::uint64_t hilbert_key(std::uint32_t x, std::uint32_t y) {
  constexpr std::uint32_t last = (std::uint32_t{1} << hilbert_bits) - 1;
  std::uint64_t key = 0;
  for (int bit = hilbert_bits - 1; bit >= 0; --bit) {
    const std::uint32_t right = (x >> bit) & 1U, upper = (y >> bit) & 1U;
    key = 4 * key + ((3 * right) ^ upper);
    if (upper == 1) continue;
    if (right == 1) {
      x = last - x;
      y = last - y;
    }
    std::swap(x, y);
  }
  return key;
}

}  // namespace quadloop
