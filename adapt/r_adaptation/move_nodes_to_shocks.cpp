#include "adapt/r_adaptation/move_nodes_to_shocks.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "adapt/metric/node_bends.hpp"
#include "adapt/metric/target_metric.hpp"
#include "adapt/r_adaptation/cell_targets.hpp"
#include "adapt/r_adaptation/transferred_norm.hpp"
#include "mesher/base/log.hpp"
#include "smoother/outline/boundary_slide.hpp"
#include "smoother/smooth_mesh.hpp"
#include "smoother/sweeps/rings.hpp"

namespace quadloop::adapt {

namespace {

/// Number of rounds; each recomputes the targets at the moved nodes, then moves nodes towards them.
constexpr int rounds = 4;
/// Cells with lower cost (Eq. 3.2) are left alone: a stretch of 1.15 does not justify a move.
constexpr double least_cost = 1e-4;
/// Number of cells around a shock that move with it; without a limit movement spreads to the outer boundary.
constexpr int reach = 4;

/// The requirements of the solution at the owned nodes of the solved mesh; no rows if all variables are
/// linear.
struct Asked {
  Field metric;  ///< logarithm of the metric
  Field bends;   ///< absolute second derivatives
};

/// The tree limits sizes from above, so the metric does not need to. *Collective.*
Asked asked_of(const Communicator& comm, const MeshInput& input, const Mesh& solved, const Field& solution,
               const TargetDemand& demand, const MeshResult& result) {
  const TreeAttributes& a = result.tree.attributes;
  const double extent = a.tree_edge * std::max(a.trees_x, a.trees_y);
  const SizeBounds bounds{
      demand.min / demand.stretch, std::vector<double>(solved.points.size(), extent),
      0.5 * (input.mesh.size.gradation - 1),
      demand.facets ? std::vector<double>() : least_at_facets(input.geometry, solved.points)};
  const std::vector<Symmetric> bends =
      variable_bends(comm, solved, selected(solution, demand.variables, "adapt.variable"));
  const TargetMetric wanted(comm, solved, bends, demand.norm, bounds);
  if (wanted.flat()) return {};
  const auto nodes = static_cast<double>(comm.sum(std::int64_t{result.mesh.owned_nodes}));
  const std::vector<LogMetric> metrics = wanted.before_bounds(nodes);
  return {rows_of({metrics.begin(), metrics.end()}, solved.owned_nodes), rows_of(bends, solved.owned_nodes)};
}

/// Flags the owned nodes on the outer edge of layers. *Collective.*
NodeFlags nodes_of_front(const Communicator& comm, const MeshInput& input, const Mesh& mesh) {
  const std::vector<double>& heights = input.smooth.front_heights;
  if (heights.empty()) return {};
  const smoother::OutlinePath outline(input.geometry);
  const HaloMesh halo(comm, mesh);
  const NodeFlags none;
  smoother::BoundarySlide slide(comm, halo, mesh.boundaries, &outline, none);
  NodeFlags flags(mesh.owned_nodes, 0);
  for (const HaloEdge& edge : halo.boundary_edges()) {
    if (!(slide.height_at(edge, heights) > 0)) continue;
    for (const NodeId node : {edge.from, edge.to}) {
      if (halo.owns(node)) flags[node] = 1;
    }
  }
  return flags;
}

/// Flags additionally the owned nodes that must stay: those farther than `reach` cells from each cell that is
/// to become half as thick. *Collective.*
void pin_far_from_fronts(const Communicator& comm, const Mesh& mesh, const std::vector<double>& thinning,
                         NodeFlags& pinned) {
  constexpr double half_as_thin = 2;
  const HaloMesh halo(comm, mesh);
  const std::vector<double> of_cells = halo.spread(comm, thinning);
  NodeFlags near(halo.points().size(), 0);
  std::size_t cell = 0;
  halo.for_each_cell([&](const auto& nodes) {
    if (of_cells[cell++] >= half_as_thin) flag_all(nodes, near);
  });
  smoother::grow(halo, near, reach);
  pinned.resize(mesh.owned_nodes, 0);
  for (const NodeId node : pinned.ids()) {
    if (near[node] == 0) pinned[node] = 1;
  }
}

/// Cells keep their places in the tree, so edges are not flipped.
smoother::SmoothOptions options_for(const Communicator& comm, const MeshInput& input,
                                    const MeshResult& result) {
  smoother::SmoothOptions options = smooth_options_for(input, result.report.finest_allowed);
  options.pinned = nodes_of_front(comm, input, result.mesh);
  options.front_heights.clear();
  options.delaunay = nullptr;
  options.threshold = least_cost;
  return options;
}

}  // namespace

void move_nodes_to_shocks(const Communicator& comm, const MeshInput& input, const Mesh& solved,
                          const Field& solution, const TargetDemand& demand, MeshResult& result) {
  const Asked asked = asked_of(comm, input, solved, solution, demand, result);
  if (!comm.any(!asked.metric.values.empty())) {
    result.report.warnings.emplace_back(
        "smooth.targets = \"solution\": no variable has a second derivative, no node is moved");
    return;
  }
  smoother::SmoothOptions options = options_for(comm, input, result);
  const ShapesOfTree shapes(result.mesh);
  BestPlaces best(comm, solved, asked.bends, demand.norm, result.mesh);
  for (int round = 0; round < rounds; ++round) {
    const auto metrics = transferred<LogMetric>(comm, solved, asked.metric, result.mesh);
    if (round == 0)
      pin_far_from_fronts(comm, result.mesh, shapes.thinning(result.mesh, metrics), options.pinned);
    options.targets = shapes.targets(result.mesh, metrics, demand.stretch);
    const smoother::SmoothReport report = smoother::smooth_mesh(comm, result.mesh, options);
    best.look_at(result.mesh);
    log::detail(fmt::format("targets: {} moves of {} nodes in {} sweeps; largest cost {:.4f}, before {:.4f}",
                            report.moves, report.free_nodes, report.sweeps, report.worst_cost_after,
                            report.worst_cost_before));
  }
  log::detail(fmt::format("targets: norm of the transferred error {:.4g}, before {:.4g}", best.least(),
                          best.first()));
  if (!(best.least() < best.first()))
    result.report.warnings.push_back(
        fmt::format("smooth.targets = \"solution\": no node is moved, because that would not reduce the norm "
                    "{:.4g} of the error with p = {}",
                    best.first(), demand.norm));
  result.mesh.points = best.places();
}

}  // namespace quadloop::adapt
