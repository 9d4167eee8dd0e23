#pragma once

#include <cstdint>

#include "adapt/metric/tile/tile_mesh.hpp"

namespace quadloop {

/// How much was done.
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

/// Splits edges longer than sqrt(2) in the metric, the longest first, collapses those shorter than 1 /
/// sqrt(2), flips, and moves nodes, in turn: a few times, so that no triangle becomes more than some 4^2 at
/// once. The result depends on the tile's nodes and triangles in their order alone.
TileChanges adapt_tile(TileMesh& mesh);

}  // namespace quadloop
