#pragma once

#include <functional>
#include <vector>

#include "adapt/metric/tiles.hpp"

namespace quadloop::adapt {

/// The logarithm of the target metric at the owned nodes and ghost copies of a mesh. *Collective.*
using MetricAt = std::function<std::vector<LogMetric>(const Mesh&)>;

struct UnitMeshOptions {
  std::int64_t tile_size = TileCut{}.size;
  int rounds = 10;      ///< at most
  int first_round = 0;  ///< where borders of tiles lie: other than in rounds before
};

/// Adapts a mesh of triangles until its edges have a length of about 1 in the metric: edges longer than
/// sqrt(2) are split, edges shorter than 1 / sqrt(2) collapse, edges flip and nodes move to improve the
/// triangles' quality in the metric (quality_in). Boundary nodes lie on the geometry; kept vertices and edges
/// with layers do not change. Nodes are numbered along a space-filling curve. The mesh has the same bits on
/// any number of ranks, and each rank holds only some tiles of it. Returns the changes of the last round.
/// *Collective.*
TileChanges adapt_to_metric(const Communicator& comm, Mesh& mesh, const MetricAt& metric_at,
                            const Walls& walls, const UnitMeshOptions& options);

}  // namespace quadloop::adapt
