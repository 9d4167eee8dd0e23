#include "adapt/metric/unit_mesh.hpp"

#include <fmt/format.h>

#include "mesher/base/log.hpp"

namespace quadloop::adapt {

namespace {

constexpr int least_rounds = 3;
/// Fraction of nodes added and removed in a round below which adaptation ends.
constexpr double settled_share = 0.003;

}  // namespace

TileChanges adapt_to_metric(const Communicator& comm, Mesh& mesh, const MetricAt& metric_at,
                            const Walls& walls, const UnitMeshOptions& options) {
  TileChanges changes;
  for (int round = 0; round < options.rounds; ++round) {
    std::vector<LooseTriangle> triangles = loosened(comm, mesh, metric_at(mesh));
    const std::int64_t nodes = comm.sum(std::int64_t{mesh.owned_nodes});
    changes = adapt_in_tiles(comm, {options.tile_size, options.first_round + round}, walls, nodes, triangles);
    mesh = joined(comm, triangles, mesh.boundaries);
    log::detail(fmt::format("metric: {} nodes, {} splits, {} collapses, {} flips, {} moves", nodes,
                            changes.splits, changes.collapses, changes.flips, changes.moves));
    if (round + 1 >= least_rounds &&
        static_cast<double>(changes.nodes()) < settled_share * static_cast<double>(nodes))
      break;
  }
  return changes;
}

}  // namespace quadloop::adapt
