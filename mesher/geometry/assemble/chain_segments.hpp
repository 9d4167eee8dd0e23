#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

/// A segment of a chain.
struct ChainSegment {
  std::size_t chain = 0, part = 0;  ///< the number of its chain, and of the segment in it
  CurvedSegment segment;
  /// The first segment with the same curve, in either direction; its own number if it is straight.
  std::int32_t first_equal = 0;
  bool is_reverse = false;  ///< against the direction of the first one
};

/// All segments of chains, in order, closing ones included.
std::vector<ChainSegment> segments_of(const std::vector<Chain>& chains);

/// Replaces each segment of the chains by the pieces of its first equal one: `pieces` has a list for each of
/// `segments`, empty for those with an earlier equal one.
void replace_segments(std::vector<Chain>& chains, std::span<const ChainSegment> segments,
                      std::span<const std::vector<CurvedSegment>> pieces);

}  // namespace quadloop
