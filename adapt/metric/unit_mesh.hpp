#pragma once

#include <functional>
#include <vector>

#include "adapt/metric/tiles.hpp"

namespace quadloop {

/// The logarithm of the metric wanted at the owned nodes and copies of a mesh. *Collective.*
using MetricAt = std::function<std::vector<LogMetric>(const Mesh&)>;

struct UnitMeshOptions {
  std::int64_t tile_size = TileCut{}.size;
  int rounds = 10;      ///< at most
  int first_round = 0;  ///< where borders of tiles lie: other than in rounds before
};

/// Adapts a mesh of triangles until its edges have about length 1 in the metric: edges longer than sqrt(2)
/// are split, those shorter than 1 / sqrt(2) collapse, edges flip and nodes move for triangles near the
/// equilateral one in the metric (quality_in). Nodes of the boundary lie on the outline, kept vertices and
/// the edges that layers stand on stay. Nodes are numbered along a space-filling curve. The mesh has the same
/// bits on any number of ranks, none of which holds more of it than some tiles. Returns what was done in the
/// last round. *Collective.*
TileChanges adapt_to_metric(const Communicator& comm, Mesh& mesh, const MetricAt& metric_at,
                            const Walls& walls, const UnitMeshOptions& options);

}  // namespace quadloop
