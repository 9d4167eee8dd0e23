#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/forest/lattice.hpp"
#include "mesher/geometry/shifted_outline.hpp"

namespace quadloop {

/// Where the outline crosses a side of a leaf. Sides: 0 bottom, 1 right, 2 top, 3 left.
struct Crossing {
  std::int32_t segment = -1;
  int side = 0;
  bool enters = false;  ///< into the leaf
  Point position;       ///< rounded once; the same for both leaves at the side
};

/// The outline's run through a leaf: from a crossing over vertices inside to a crossing, or a whole loop inside (no crossings).
struct Piece {
  std::int32_t entry = -1, exit = -1;               ///< numbers of crossings; -1 for a loop
  std::int32_t first_segment = -1;                  ///< the segment that the piece begins on
  std::int32_t vertices_begin = 0, vertices_end = 0;  ///< its vertices inside the leaf, in LeafTrace::vertices
};

/// All of the outline inside one leaf, cut at its sides (thesis Fig. 3.10, 3.11).
struct LeafTrace {
  Box box;
  std::vector<Crossing> crossings;
  std::vector<Piece> pieces;
  std::vector<std::int32_t> vertices;

  std::span<const std::int32_t> vertices_of(const Piece& p) const {
    return std::span(vertices).subspan(static_cast<std::size_t>(p.vertices_begin), static_cast<std::size_t>(p.vertices_end - p.vertices_begin));
  }
};

/// Traces the outline through the leaf. `segments` are those that meet its inside, in ascending order. Exact in its decisions; the positions
/// of crossings are rounded. Work and memory depend on these segments alone. Reuses the memory of `trace`.
void trace_leaf(const ShiftedOutline& outline, const Box& box, std::span<const std::int32_t> segments, LeafTrace& trace);

}  // namespace quadloop
