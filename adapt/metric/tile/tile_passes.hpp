#pragma once

#include <cstdint>

#include "adapt/metric/tile/tile_mesh.hpp"

namespace quadloop::adapt {

/// Counts of operations.
struct TileChanges {
  std::int64_t splits = 0, collapses = 0, flips = 0, moves = 0;

  std::int64_t nodes() const { return splits + collapses; }
  TileChanges& operator+=(const TileChanges& more) {
    splits += more.splits;
    collapses += more.collapses;
    flips += more.flips;
    moves += more.moves;
    return *this;
  }
};

/// Splits edges longer than sqrt(2) in the metric, the longest first, collapses edges shorter than 1 /
/// sqrt(2), flips edges and moves nodes, several times in turn; one call divides a triangle into at most
/// about 4^2. The result depends only on the tile's nodes and triangles in their order.
TileChanges adapt_tile(TileMesh& mesh);

}  // namespace quadloop::adapt
