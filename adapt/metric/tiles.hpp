#pragma once

#include <cstdint>
#include <vector>

#include "adapt/metric/loose_triangles.hpp"
#include "adapt/metric/tile/tile_passes.hpp"

namespace quadloop::adapt {

/// Division of a mesh into tiles; depends on its triangles and these parameters only, not on the number of
/// ranks.
struct TileCut {
  std::int64_t size = 8192;  ///< approximate number of triangles per tile after adaptation
  int round = 0;             ///< borders are at different places in every round
};

/// Adapts every tile separately. Tiles are ranges of a space-filling curve, distributed over the ranks; their
/// borders do not change. Triangles are returned in the order of the curve. Their nodes have ids from 0; ids
/// below `first_new` are those of existing nodes. *Collective.*
TileChanges adapt_in_tiles(const Communicator& comm, const TileCut& cut, const Walls& walls,
                           std::int64_t first_new, std::vector<LooseTriangle>& triangles);

}  // namespace quadloop::adapt
