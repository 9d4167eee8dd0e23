#include "adapt/metric/stretch_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "adapt/metric/crossing_walls.hpp"
#include "adapt/metric/leaf_shares.hpp"
#include "adapt/metric/node_bends.hpp"
#include "adapt/metric/target_metric.hpp"
#include "adapt/metric/unit_mesh.hpp"
#include "adapt/transfer/transfer.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/log.hpp"
#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"

namespace quadloop::adapt {

namespace {

/// Allowed number of nodes, with a tolerance, as results differ between rounds.
std::int64_t with_room(std::int64_t nodes) { return std::llround(1.05 * static_cast<double>(nodes)); }

/// Edge of equilateral triangles with the density of halves of a unit square.
constexpr double size_for_leaf = 1.0745699318235418;

/// The logarithm of the largest size that the leaves around each owned node allow. *Collective.*
Field leaf_sizes(const Communicator& comm, const MeshResult& result) {
  std::vector<double> of_cells;
  for (const LeafRecord& leaf : result.tree.leaves) {
    const double edge = std::ldexp(result.tree.attributes.tree_edge, -leaf.level);
    of_cells.insert(of_cells.end(), static_cast<std::size_t>(leaf.triangles), size_for_leaf * edge);
  }
  const HaloMesh halo(comm, result.mesh);
  of_cells = halo.spread(comm, of_cells);
  Field sizes{{"size"}, std::vector<double>(static_cast<std::size_t>(result.mesh.owned_nodes), 0), {}};
  std::size_t cell = 0;
  halo.for_each_cell([&](const auto& nodes) {
    for (const NodeId node : nodes) {
      if (halo.owns(node)) sizes.values[node.value()] = std::max(sizes.values[node.value()], of_cells[cell]);
    }
    ++cell;
  });
  for (double& size : sizes.values) size = std::log(size);
  return sizes;
}

/// At owned nodes and ghost copies of the solved mesh. *Collective.*
std::vector<double> largest_sizes(const Communicator& comm, const MeshResult& result, const Mesh& solved) {
  const Field sizes = transfer(comm, result.mesh, leaf_sizes(comm, result), solved).field;
  std::vector<double> largest = with_ghosts(comm, solved, sizes).values;
  for (double& size : largest) size = std::exp(size);
  return largest;
}

/// Metrics of the solved mesh transferred to other meshes.
class TransferredMetric {
 public:
  TransferredMetric(const Communicator& comm, const Mesh& solved, const std::vector<LogMetric>& metrics)
      : comm_{comm}, solved_{solved}, field_{{"xx", "xy", "yy"}, {}, {}} {
    for (std::int32_t n = 0; n < solved.owned_nodes; ++n)
      field_.values.insert(field_.values.end(), {metrics[n].xx, metrics[n].xy, metrics[n].yy});
  }
  /// *Collective.*
  std::vector<LogMetric> at(const Mesh& mesh) const {
    const Field transferred = with_ghosts(comm_, mesh, transfer(comm_, solved_, field_, mesh).field);
    std::vector<LogMetric> metrics;
    for (std::size_t i = 0; i < transferred.values.size(); i += 3)
      metrics.emplace_back(
          Symmetric{transferred.values[i], transferred.values[i + 1], transferred.values[i + 2]});
    return metrics;
  }

 private:
  const Communicator& comm_;
  const Mesh& solved_;
  Field field_;
};

/// Expected number of nodes in layers: that of the solved mesh, whose layers were made in the same way.
/// *Collective.*
std::int64_t nodes_in_layers(const Communicator& comm, const Mesh& solved) {
  if (!has_layers(solved)) return 0;
  const LayerPlaces places = layer_places(comm, solved);
  std::int64_t nodes = 0;
  for (std::int32_t n = 0; n < solved.owned_nodes; ++n) nodes += places[NodeId{n}].left > 0 ? 1 : 0;
  return comm.sum(nodes);
}

/// *Collective.*
std::vector<Symmetric> bends(const Communicator& comm, const Mesh& solved, const Field& solution,
                             const MetricDemand& demand) {
  const auto field = [&](std::span<const std::string> names) {
    return selected(solution, names, "adapt.variable");
  };
  std::vector<Symmetric> of_variables = variable_bends(comm, solved, field(demand.variables));
  if (demand.error.empty() || !comm.any(!of_variables.empty())) return of_variables;
  return error_bends(comm, solved, field(std::vector{demand.error}), std::move(of_variables));
}

std::vector<std::string> names_of(const std::vector<BoundaryEdges>& boundaries) {
  std::vector<std::string> names;
  for (const BoundaryEdges& boundary : boundaries) names.push_back(boundary.name);
  return names;
}

/// Adapts the mesh repeatedly, changing the metric's complexity according to the number of nodes.
class Stretching {
 public:
  Stretching(const Communicator& comm, const MeshInput& input, const Mesh& solved, const Field& solution,
             const MetricDemand& demand, const MeshResult& result)
      : comm_{comm},
        solved_{solved},
        demand_{demand},
        outline_{input.geometry},
        walls_{outline_, names_of(result.mesh.boundaries), input.smooth.front_heights},
        metric_{comm,
                solved,
                bends(comm, solved, solution, demand),
                demand.norm,
                {demand.min, largest_sizes(comm, result, solved), 0.5 * (input.mesh.size.gradation - 1),
                 demand.facets ? std::vector<double>() : least_at_facets(input.geometry, solved.points)}},
        wanted_{demand.nodes - nodes_in_layers(comm, solved)} {}

  StretchReport report;

  /// The number of nodes of a mesh with the largest allowed sizes. *Collective.*
  std::int64_t least_nodes(Mesh mesh) {
    constexpr double next_to_nothing = 1e-3;
    int round = 0;
    const double nodes = adapt(mesh, next_to_nothing, 12, round);
    return static_cast<std::int64_t>(nodes);
  }

  /// An adapted mesh without crossing walls. *Collective.*
  Mesh sound(const Mesh& start) {
    const std::vector<WallSpan> known = wall_edges(comm_, start);
    Mesh mesh = stretched(start);
    const auto met = crossing_walls(wall_edges(comm_, mesh), known);
    if (!met) return mesh;
    const Point at = met->one.from();
    log::detail(fmt::format("metric: walls meet near ({:.6g}, {:.6g}): their nodes are kept", at.x, at.y));
    walls_.keep_nodes();
    report = {};
    mesh = stretched(start);
    if (const auto still = crossing_walls(wall_edges(comm_, mesh), known)) refuse(mesh, *still);
    return mesh;
  }

 private:
  [[noreturn]] static void refuse(const Mesh& mesh, const CrossingWalls& met) {
    const Point at = 0.5 * (met.one.from() + met.one.to());
    throw InputError(fmt::format(
        "mesh.type = \"metric\": edges of the boundaries \"{}\" and \"{}\" meet near ({:.6g}, {:.6g}): give "
        "them a smaller `spacing`, or use a larger adapt.min",
        mesh.boundaries[met.one.boundary].name, mesh.boundaries[met.other.boundary].name, at.x, at.y));
  }

  struct Attempt {
    double complexity = 0, nodes = 0;
  };

  /// A mesh with at most the target number of nodes.
  struct Fitting {
    Mesh mesh;
    MetricStatistics statistics;
  };

  std::int64_t nodes_of(const Mesh& mesh) const { return comm_.sum(std::int64_t{mesh.owned_nodes}); }

  /// The mesh of the tree if it has few enough nodes while attempts have too many; otherwise none.
  /// *Collective.*
  std::optional<Fitting> unstretched(const Mesh& start, double complexity) {
    if (nodes_of(start) > wanted_) return std::nullopt;
    const TransferredMetric transferred(comm_, solved_, metric_.of_complexity(complexity));
    return Fitting{start, metric_statistics(comm_, start, transferred.at(start))};
  }

  /// Exceeds the target number of nodes only if the mesh of the tree does. *Collective.*
  Mesh stretched(const Mesh& start) {
    constexpr int attempts = 5, most_attempts = 10;  // further attempts only while nodes are too many
    constexpr double enough = 0.95, aim = 0.975;
    constexpr double nodes_of_unit = 1.3;  // a first guess
    if (metric_.flat()) {
      report.warnings.emplace_back("no variable has a second derivative: the mesh is that of the quadtree");
      return start;
    }
    Mesh mesh = start;
    std::optional<Fitting> fitting;  // the last attempt that has few enough nodes
    const auto wanted = static_cast<double>(std::max<std::int64_t>(wanted_, 1));
    Attempt last, now{wanted / nodes_of_unit, 0};
    int round = 0;
    for (int attempt = 0; attempt < most_attempts; ++attempt) {
      now.nodes = adapt(mesh, now.complexity, attempt == 0 ? 12 : 5, round);
      if (now.nodes <= wanted && now.nodes >= enough * wanted) return mesh;
      if (attempt + 1 >= attempts && (now.nodes <= wanted || is_floor(last, now))) break;
      if (now.nodes <= wanted) fitting = {mesh, report.statistics};
      last = now;
      now.complexity *= aim * wanted / now.nodes;
    }
    warn(last, now);
    if (now.nodes <= wanted) return mesh;
    if (!fitting) fitting = unstretched(start, now.complexity);
    if (fitting) {
      mesh = std::move(fitting->mesh);
      report.statistics = fitting->statistics;
    }
    report.warnings.back() += fmt::format("; the mesh has {} nodes", all_nodes(nodes_of(mesh)));
    return mesh;
  }

  /// Returns the number of nodes after adaptation. *Collective.*
  double adapt(Mesh& mesh, double complexity, int rounds, int& round) {
    const TransferredMetric transferred(comm_, solved_, metric_.of_complexity(complexity));
    const auto metric_at = [&](const Mesh& m) { return transferred.at(m); };
    adapt_to_metric(comm_, mesh, metric_at, walls_, {demand_.tile_size, rounds, round});
    round += rounds;
    report.statistics = metric_statistics(comm_, mesh, transferred.at(mesh));
    return static_cast<double>(nodes_of(mesh));
  }

  /// Including nodes of layers.
  std::int64_t all_nodes(std::int64_t outside) const { return outside + demand_.nodes - wanted_; }

  /// Less complexity hardly reduces the number of nodes.
  static bool is_floor(const Attempt& last, const Attempt& now) {
    return now.complexity < 0.99 * last.complexity && now.nodes > 0.998 * last.nodes;
  }
  /// More complexity hardly increases the number of nodes.
  static bool is_ceiling(const Attempt& last, const Attempt& now) {
    return now.complexity > 1.04 * last.complexity && now.nodes < 1.01 * last.nodes;
  }

  void warn(const Attempt& last, const Attempt& now) {
    const auto nodes = static_cast<std::int64_t>(now.nodes);
    const std::int64_t all = all_nodes(nodes);
    if (nodes <= wanted_) {
      if (is_ceiling(last, now))
        report.warnings.push_back(
            fmt::format("the mesh has {} of the {} nodes of adapt.max_nodes: adapt.min allows no more", all,
                        demand_.nodes));
      return;
    }
    report.warnings.push_back(fmt::format(
        "the anisotropic mesh needs {} nodes, but adapt.max_nodes is {}: {}", all, demand_.nodes,
        is_floor(last, now)
            ? fmt::format("the case's own sizes need all of them; set at least {}, preferably twice that, or "
                          "increase spacing.max and the spacings of the boundaries",
                          with_room(all))
            : "the number could not be reduced further"));
  }

  const Communicator& comm_;
  const Mesh& solved_;
  const MetricDemand& demand_;
  smoother::OutlinePath outline_;
  Walls walls_;
  TargetMetric metric_;
  std::int64_t wanted_;
};

}  // namespace

std::int64_t least_nodes_of_metric(const Communicator& comm, const MeshInput& input, double min,
                                   const MeshResult& result) {
  Field even{{"q"}, {}, {}};  // a function with constant second derivatives
  for (std::int32_t n = 0; n < result.mesh.owned_nodes; ++n) {
    const Point p = result.mesh.point(NodeId{n});
    even.values.push_back(dot(p, p));
  }
  MetricDemand demand{even.names, {}, 2};
  demand.min = min;
  return with_room(Stretching(comm, input, result.mesh, even, demand, result).least_nodes(result.mesh));
}

StretchReport stretch_mesh(const Communicator& comm, const MeshInput& input, const Mesh& solved,
                           const Field& solution, const MetricDemand& demand, MeshResult& result) {
  Stretching stretching(comm, input, solved, solution, demand, result);
  const Mesh mesh = stretching.sound(result.mesh);
  const TreeAttributes& a = result.tree.attributes;
  share_among_leaves(comm, TreeGrid(root_box(a), a.trees_x, a.trees_y), mesh, result);
  return std::move(stretching.report);
}

}  // namespace quadloop::adapt
