#pragma once

#include <cstdint>

namespace quadloop {

/// Inserts a zero bit between consecutive bits of a number.
constexpr std::uint64_t spread_bits(std::uint32_t number) {
  std::uint64_t bits = number;
  bits = (bits | (bits << 16)) & 0x0000ffff0000ffffULL;
  bits = (bits | (bits << 8)) & 0x00ff00ff00ff00ffULL;
  bits = (bits | (bits << 4)) & 0x0f0f0f0f0f0f0f0fULL;
  bits = (bits | (bits << 2)) & 0x3333333333333333ULL;
  return (bits | (bits << 1)) & 0x5555555555555555ULL;
}

/// Returns the key of a square on the Morton curve (Morton 1966).
constexpr std::uint64_t morton_key(std::uint32_t x, std::uint32_t y) {
  return spread_bits(x) | (spread_bits(y) << 1);
}

}  // namespace quadloop
