#pragma once

#include <cstdint>
#include <vector>

#include "adapt/metric/loose_triangles.hpp"
#include "adapt/metric/tile/tile_passes.hpp"

namespace quadloop {

/// How a mesh is cut into tiles: by its triangles and this alone, whatever the number of ranks.
struct TileCut {
  std::int64_t size = 8192;  ///< triangles, about, that are expected in a tile once it is adapted
  int round = 0;             ///< borders lie elsewhere in every round
};

/// Adapts every tile by itself: stretches of a space-filling curve, shared out over the ranks. What lies at
/// the border of a tile stays. Triangles come back along the curve, their nodes with ids from 0 on, of which
/// those below `first_new` are those of nodes that were there before. *Collective.*
TileChanges adapt_in_tiles(const Communicator& comm, const TileCut& cut, const Walls& walls,
                           std::int64_t first_new, std::vector<LooseTriangle>& triangles);

}  // namespace quadloop
