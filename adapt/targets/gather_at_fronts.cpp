#include "adapt/targets/gather_at_fronts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "adapt/metric/node_bends.hpp"
#include "adapt/metric/wanted_metric.hpp"
#include "adapt/targets/cell_targets.hpp"
#include "adapt/transfer/transfer.hpp"
#include "mesher/base/log.hpp"
#include "smoother/outline/boundary_slide.hpp"
#include "smoother/smooth_mesh.hpp"

namespace quadloop {

namespace {

/// Each time targets are made where nodes have got to, and nodes move towards them.
constexpr int rounds = 4;
/// Cells that cost less (Eq. 3.2) are left as they are: a stretch of 1.15 is not worth a move.
constexpr double least_cost = 1e-4;

/// The logarithm of the metric at the owned nodes of the solved mesh; no rows where all variables are linear.
/// The tree bounds sizes from above, so the metric need not. *Collective.*
Field wanted_metric(const Communicator& comm, const MeshInput& input, const Mesh& solved,
                    const Field& solution, const TargetDemand& demand, const MeshResult& result) {
  const TreeAttributes& a = result.tree.attributes;
  const double extent = a.tree_edge * std::max(a.trees_x, a.trees_y);
  const SizeBounds bounds{demand.min / demand.stretch, std::vector<double>(solved.points.size(), extent),
                          0.5 * (input.mesh.size.gradation - 1)};
  const WantedMetric wanted(
      comm, solved, variable_bends(comm, solved, selected(solution, demand.variables, "adapt.variable")),
      demand.norm, bounds);
  Field field{{"xx", "xy", "yy"}, {}, {}};
  if (wanted.flat()) return field;
  const auto nodes = static_cast<double>(comm.sum(std::int64_t{result.mesh.owned_nodes}));
  const std::vector<LogMetric> metrics = wanted.before_bounds(nodes);
  for (std::int32_t n = 0; n < solved.owned_nodes; ++n)
    field.values.insert(field.values.end(), {metrics[n].xx, metrics[n].xy, metrics[n].yy});
  return field;
}

/// At the owned nodes and copies of another mesh. *Collective.*
std::vector<LogMetric> carried(const Communicator& comm, const Mesh& solved, const Field& metric,
                               const Mesh& mesh) {
  const Field there = with_copies(comm, mesh, transfer(comm, solved, metric, mesh).field);
  std::vector<LogMetric> metrics;
  for (std::size_t i = 0; i < there.values.size(); i += 3)
    metrics.emplace_back(Symmetric{there.values[i], there.values[i + 1], there.values[i + 2]});
  return metrics;
}

/// Flags the owned nodes on which layers are to stand. *Collective.*
NodeFlags nodes_of_front(const Communicator& comm, const MeshInput& input, const Mesh& mesh) {
  const std::vector<double>& heights = input.smooth.front_heights;
  if (heights.empty()) return {};
  const OutlinePath outline(input.geometry);
  const HaloMesh halo(comm, mesh);
  const NodeFlags none;
  const BoundarySlide slide(comm, halo, mesh.boundaries, &outline, none);
  NodeFlags flags(mesh.owned_nodes, 0);
  for (const HaloEdge& edge : halo.boundary_edges()) {
    if (!(slide.height_at(edge, heights) > 0)) continue;
    for (const NodeId node : {edge.from, edge.to}) {
      if (halo.owns(node)) flags[node] = 1;
    }
  }
  return flags;
}

/// Cells keep their places in the tree, so that edges are not flipped.
SmoothOptions options_for(const Communicator& comm, const MeshInput& input, const MeshResult& result) {
  SmoothOptions options = smooth_options_for(input, result.report.finest_allowed);
  options.pinned = nodes_of_front(comm, input, result.mesh);
  options.front_heights.clear();
  options.delaunay = nullptr;
  options.threshold = least_cost;
  return options;
}

}  // namespace

void gather_at_fronts(const Communicator& comm, const MeshInput& input, const Mesh& solved,
                      const Field& solution, const TargetDemand& demand, MeshResult& result) {
  const Field metric = wanted_metric(comm, input, solved, solution, demand, result);
  if (!comm.any(!metric.values.empty())) {
    result.report.warnings.emplace_back(
        "smooth.targets = \"solution\": no variable has a second derivative, no node is moved");
    return;
  }
  SmoothOptions options = options_for(comm, input, result);
  const ShapesOfTree shapes(result.mesh);
  for (int round = 0; round < rounds; ++round) {
    options.targets = shapes.targets(result.mesh, carried(comm, solved, metric, result.mesh), demand.stretch);
    const SmoothReport report = smooth_mesh(comm, result.mesh, options);
    log::detail(fmt::format("targets: {} moves of {} nodes in {} sweeps; largest cost {:.4f}, before {:.4f}",
                            report.moves, report.free_nodes, report.sweeps, report.worst_cost_after,
                            report.worst_cost_before));
  }
}

}  // namespace quadloop
