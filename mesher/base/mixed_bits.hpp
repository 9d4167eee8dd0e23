#pragma once

#include <cstdint>

namespace quadloop {

/// Mixes the bits of a word such that each input bit changes about half of the output bits (the finaliser of
/// SplitMix64; Steele, Lea and Flood 2014).
inline std::uint64_t mixed_bits(std::uint64_t word) {
  word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9U;
  word = (word ^ (word >> 27)) * 0x94d049bb133111ebU;
  return word ^ (word >> 31);
}

/// Increment of SplitMix64, without which mixed_bits() maps 0 to 0.
inline constexpr std::uint64_t golden_step = 0x9e3779b97f4a7c15U;

}  // namespace quadloop
