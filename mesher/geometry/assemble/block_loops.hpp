#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesher/geometry/outline.hpp"

namespace quadloop {

/// A block of the domain, defined by one of three: the boundaries that bound it, a boundary that it is inside
/// of, or a point of it.
struct BlockRule {
  std::string name;
  std::vector<std::string> boundaries;
  std::string loop;
  std::optional<Point> inside;
  std::string where;                   ///< where the rule stands, for messages
  std::optional<double> spacing = {};  ///< largest cell size in the block
};

/// The loops of blocks, each with its block on the left. A segment between two blocks is in loops of both.
struct BlockOutline {
  Outline outline;
  std::vector<std::string> names;           ///< of the blocks, as first seen
  std::vector<std::int32_t> block_of_loop;  ///< index into the names
};

/// Finds the blocks' loops. Chains are split where they meet, and become one where they coincide (both within
/// `near`, along each axis). The faces between them belong to the last rule that covers them: those with the
/// rule's boundaries between them and the outside, crossed an odd number of times, or that of its point.
/// Parts of chains with one block on both sides, or none, are left out, with a warning unless a later rule
/// covers them. A boundary of which every edge lies between the same two blocks keeps its name; otherwise the
/// edges between blocks A and B are the boundary "A__B". Inner lines bound no block: loops run along them and
/// back, also where they lie apart from all others. Throws InputError with a place if a rule's boundaries do
/// not close, or a rule has no face, or an inner line lies in no block.
BlockOutline block_loops(const std::vector<Chain>& chains, const std::vector<BlockRule>& rules, double near,
                         std::vector<std::string>& warnings);

}  // namespace quadloop
