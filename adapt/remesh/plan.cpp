#include "adapt/remesh/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include "adapt/remesh/demands/finest_levels.hpp"
#include "adapt/remesh/demands/mark_family.hpp"
#include "adapt/remesh/demands/mirrored_leaves.hpp"
#include "adapt/remesh/demands/restart.hpp"
#include "adapt/remesh/demands/target_levels.hpp"
#include "adapt/remesh/demands/trial_count.hpp"
#include "adapt/remesh/followed_wakes.hpp"
#include "adapt/remesh/followed_walls.hpp"
#include "generate/leaf_quadrant.hpp"
#include "mesher/base/counted.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/shared_stage.hpp"
#include "mesher/geometry/facets.hpp"
#include "mesher/grid/tree_grid.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"

namespace quadloop::adapt {

namespace {

/// Searches the family of markings for one that gives 95 to 100 % of the allowed number of nodes.
class NodeSearch {
 public:
  NodeSearch(const Communicator& comm, const TrialCount& count, const SolvedMesh& solved,
             const MarkFamily& family, std::span<const std::int8_t> finest, std::optional<MirrorAxis> mirror)
      : comm_{comm}, count_{count}, solved_{solved}, family_{family}, finest_{finest}, mirror_{mirror} {}

  ChangedSplits changes_at(double at) const {
    ChangedSplits changes = changed_splits(comm_, solved_.tree, family_.flags(at), finest_);
    if (mirror_)  // the last mesh may lack mirror symmetry
      changes.demands = with_images(*mirror_, solved_.tree.attributes, std::move(changes.demands));
    return changes;
  }

  /// Returns the changes with the largest mesh found within the cap and the mesh limit; that with the fewest
  /// nodes if none fits. Without a cap estimates suffice.
  ChangedSplits within(const std::optional<std::int64_t>& most, ChangedSplits all) const {
    constexpr double enough = 0.95;
    constexpr int most_steps = 24;
    if (count_.filled(most, all).most <= 1) return all;
    double low = -1, high = 1;
    ChangedSplits best = changes_at(low);
    for (int step = 0; step < most_steps; ++step) {
      const double middle = 0.5 * (low + high);
      ChangedSplits tried = changes_at(middle);
      const TrialCount::Share share = count_.filled(most, tried);
      const bool fits = share.most <= 1;
      (fits ? low : high) = middle;
      if (fits) best = std::move(tried);
      if (fits && share.least >= enough) break;
    }
    return best;
  }

 private:
  const Communicator& comm_;
  const TrialCount& count_;
  const SolvedMesh& solved_;
  const MarkFamily& family_;
  std::span<const std::int8_t> finest_;
  std::optional<MirrorAxis> mirror_;
};

int finest_level(const MeshInput& input, const AdaptOptions& options) {
  const TreeGrid grid = input.grid();
  return options.min ? grid.finest_level(*options.min, "adapt.min") : grid.finest_level(input.mesh.size.min);
}

std::vector<std::int8_t> finest_of_leaves(const MeshInput& input, const AdaptOptions& options,
                                          const SolvedMesh& solved) {
  return finest_levels(input.geometry, solved.tree, finest_level(input, options), options.facets);
}

/// Returns the facet with the longest segment among those that keep flagged cells unchanged, the one of the
/// lowest vertex if several are equal; empty if there is none. *Collective.*
std::optional<Facet> holding_facet(const Communicator& comm, const Geometry& geometry,
                                   const SolvedMesh& solved, const std::vector<RefinementFlag>& flags,
                                   std::span<const std::int8_t> finest) {
  std::int8_t deepest = 0;
  for (const std::int8_t level : finest) deepest = std::max(deepest, level);
  deepest = static_cast<std::int8_t>(comm.maximum(std::int64_t{deepest}));
  const auto is_held = [&](std::size_t i) {
    const LeafRecord& leaf = solved.tree.leaves[i];
    return flags[i] == RefinementFlag::refine && finest[i] < deepest && leaf.level >= finest[i];
  };
  bool any = false;
  for (std::size_t i = 0; i < flags.size() && !any; ++i) any = is_held(i);
  if (!comm.any(any)) return {};
  const TreeAttributes& a = solved.tree.attributes;
  const TreeGrid grid(root_box(a), a.trees_x, a.trees_y);
  const FacetZones zones(geometry);
  Facet longest{geometry.size(), 0, 0};
  const auto later = [](const Facet& f) { return std::pair(-f.segment, f.vertex); };
  for (std::size_t i = 0; i < flags.size(); ++i) {
    const Facet* facet =
        is_held(i) ? zones.longest_at(grid.box_of(quadrant_of(solved.tree.leaves[i]))) : nullptr;
    if (facet != nullptr && later(*facet) < later(longest)) longest = *facet;
  }
  return std::ranges::min(comm.all_gather(longest), {}, later);
}

std::string text_of(const Facet& facet, const Geometry& geometry) {
  const Point p = geometry.point(facet.vertex);
  return fmt::format(
      "boundary '{}': its points near ({:.6g}, {:.6g}) are {:.3g} apart, too far for further refinement; in "
      "cells smaller than half of this distance the flow would resolve the corners of the polygon; supply "
      "more points, or set adapt.facets = true",
      geometry.boundary(geometry.boundary_of(facet.vertex)).name, p.x, p.y, facet.segment);
}

/// Returns the reason why a plan changes no cell, for the user. `all`: the changes flagged by the rule alone.
/// *Collective.*
std::string reason_for_no_change(const Communicator& comm, const AdaptOptions& options,
                                 const SolvedMesh& solved, const MarkFamily& family, const ChangedSplits& all,
                                 bool held) {
  if (family.flat())
    return fmt::format("{} is constant",
                       options.variables.size() == 1 ? options.variables.front() : "each of adapt.variable");
  if (all.refined + all.coarsened > 0)
    return fmt::format("{}", options.max_nodes
                                 ? fmt::format("adapt.max_nodes = {} is reached; increase it, or set "
                                               "adapt.norm, which redistributes the nodes",
                                               *options.max_nodes)
                                 : "--max-cells or free memory allows no more cells");
  const std::vector<RefinementFlag> flags = family.flags(1);
  const std::int64_t wanted = count_of(comm, flags, RefinementFlag::refine);
  if (wanted == 0 && options.source == AdaptOptions::Source::size)
    return "no cell is larger than its size in " + options.variables.front();
  if (wanted == 0)
    return "no cell is above the threshold adapt.refine, and adaptation has split no cell below "
           "adapt.coarsen";
  const std::string bound = held          ? "adapt.facets = false"
                            : options.min ? fmt::format("adapt.min = {}", *options.min)
                                          : "spacing.min, the default of adapt.min,";
  const char* const remedy = held ? "set adapt.facets = true" : "set a smaller adapt.min";
  std::int8_t coarsest = Quadrant::unit_level;
  for (std::size_t i = 0; i < flags.size(); ++i) {
    if (flags[i] == RefinementFlag::refine) coarsest = std::min(coarsest, solved.tree.leaves[i].level);
  }
  const double edge = solved.tree.attributes.tree_edge /
                      static_cast<double>(std::int64_t{1} << comm.minimum(std::int64_t{coarsest}));
  return fmt::format("{} prevents refinement of the {} above the threshold, with edges up to {:.6g}; {}",
                     bound, counted(wanted, "cell"), edge, remedy);
}

/// Constructs the object; errors of the field are reported with its file. *Collective.*
template <class Made, class... Further>
Made made_from(const Communicator& comm, const AdaptOptions& options, const SolvedMesh& solved,
               Further... further) {
  try {
    return {comm, options, solved, further...};
  } catch (const InputError& fault) {  // the same on every rank
    throw InputError(solved.file.empty() ? fault.what() : solved.file + ": " + fault.what());
  }
}

constexpr const char* text_of_bound =
    "--max-cells or free memory limits the mesh: fewer cells are refined than flagged";

void take(ChangedSplits changes, AdaptationPlan& plan) {
  plan.refined = changes.refined;
  plan.coarsened = changes.coarsened;
  plan.demands = std::move(changes.demands);
}

/// *Collective.*
void warn_above_cap(const TrialCount& count, std::int64_t cap, const ChangedSplits& changes,
                    AdaptationPlan& plan) {
  const auto [least, nodes] = count.nodes_after(changes);
  if (nodes <= cap || nodes == TrialCount::beyond) return;
  plan.warnings.push_back(
      fmt::format("the mesh has {}{} nodes, but adapt.max_nodes is {}: case and geometry alone require them",
                  least < nodes ? "up to " : "", nodes, cap));
}

void plan_by_flags(const Communicator& comm, const MeshInput& input, const AdaptOptions& options,
                   const SolvedMesh& solved, const TrialCount& count, std::span<const std::int8_t> finest,
                   AdaptationPlan& plan) {
  const auto family = made_from<MarkFamily>(comm, options, solved, input.mesh.mirror);
  const NodeSearch search(comm, count, solved, family, finest, input.mesh.mirror);
  const ChangedSplits all = search.changes_at(1);
  ChangedSplits changes = all;
  const bool bounded = !count.allowed(all);
  if (bounded) plan.warnings.emplace_back(text_of_bound);
  const auto held = holding_facet(comm, input.geometry, solved, family.flags(1), finest);
  if (held) plan.warnings.push_back(text_of(*held, input.geometry));
  if (options.max_nodes || bounded) changes = search.within(options.max_nodes, all);
  if (options.max_nodes) warn_above_cap(count, *options.max_nodes, changes, plan);
  take(std::move(changes), plan);
  plan.flat = family.flat();
  plan.mean = family.mean();
  plan.deviation = family.deviation();
  if (!plan.changes_mesh())
    plan.reason_for_no_change = reason_for_no_change(comm, options, solved, family, all, held.has_value());
}

/// Returns the number of nodes requested by the options.
std::int64_t bounded_nodes(const AdaptOptions& options, const SolvedMesh& solved) {
  const std::int64_t nodes = *options.max_nodes;
  if (!options.growth) return nodes;
  const double grown = std::floor(*options.growth * static_cast<double>(solved.tree.attributes.nodes));
  return grown < static_cast<double>(nodes) ? static_cast<std::int64_t>(grown) : nodes;
}

/// Plans by the target sizes that minimise the L^p norm of the interpolation error.
void plan_by_sizes(const Communicator& comm, const AdaptOptions& options, const SolvedMesh& solved,
                   const TrialCount& count, const std::vector<std::int8_t>& finest,
                   std::optional<MirrorAxis> mirror, AdaptationPlan& plan) {
  const auto wanted = made_from<TargetLevels>(comm, options, solved, finest, mirror);
  const std::int64_t nodes = bounded_nodes(options, solved);
  plan.estimate = wanted.error();
  plan.flat = wanted.flat();
  double complexity = 0;
  if (!wanted.flat()) {
    SizedChanges sized = changes_for_nodes(wanted, count, nodes);
    complexity = sized.complexity;
    if (sized.bounded) plan.warnings.emplace_back(text_of_bound);
    if (complexity == 0) warn_above_cap(count, nodes, sized.changes, plan);
    take(std::move(sized.changes), plan);
  } else {
    plan.demands = adapted_splits(solved.tree);
  }
  plan.estimates_of_cells = wanted.of_cells(complexity);
  if (plan.changes_mesh()) return;
  const bool by_error = options.source == AdaptOptions::Source::error;
  plan.reason_for_no_change =
      wanted.flat() ? by_error ? "the error is 0 everywhere" : "no variable has a second derivative"
                    : "all cells have their target sizes";
}

/// Returns how many of the nodes --max-cells and free memory allow.
std::int64_t allowed_nodes(const MeshLimit& limit, std::int64_t nodes) {
  constexpr double cells_of_node = 2, bytes_of_node = 4096;
  const double most = std::min(limit.cells / cells_of_node, limit.bytes / bytes_of_node);
  return static_cast<double>(nodes) > most ? static_cast<std::int64_t>(most) : nodes;
}

void require_norm(const AdaptOptions& options) {
  if (options.norm && options.max_nodes) return;
  throw InputError(
      "adapt.norm is missing: mesh.type = \"metric\" minimises the L^p norm of the interpolation error for "
      "max_nodes nodes; set norm = 2 and max_nodes");
}

void require_at_nodes(const AdaptOptions& options, const SolvedMesh& solved, const char* setting) {
  const CellValues in_cells = selected(solved.solution, options.variables, "adapt.variable").cells;
  if (in_cells.width() == 0) return;
  throw InputError(
      fmt::format("{}: '{}' is a cell variable, but {} requires node variables; remove that setting, or let "
                  "the solver write values at nodes",
                  solved.file, in_cells.names.front(), setting));
}

TargetDemand target_demand(const MeshInput& input, const AdaptOptions& options, const SolvedMesh& solved) {
  require_at_nodes(options, solved, "smooth.targets = \"solution\"");
  TargetDemand demand;
  demand.variables = options.variables;
  demand.norm = options.norm.value_or(demand.norm);
  demand.min = options.min.value_or(input.mesh.size.min);
  demand.stretch = *input.stretch;
  demand.facets = options.facets;
  return demand;
}

/// Whether a variable is the final value of another one that is a time average.
bool is_at_end(const std::string& name, const std::vector<std::string>& names) {
  constexpr std::string_view ending = "_at_end";
  return name.ends_with(ending) &&
         std::ranges::find(names, name.substr(0, name.size() - ending.size())) != names.end();
}

/// Returns the metric demand. If the solver wrote an error field, the anisotropy follows from all other
/// variables (of time-averaged flows: the averages).
MetricDemand metric_demand(const AdaptOptions& options, const Field& solution) {
  if (options.source != AdaptOptions::Source::error) return {options.variables, {}, *options.norm};
  MetricDemand demand{{}, options.variables.front(), *options.norm};
  std::ranges::copy_if(solution.names, std::back_inserter(demand.variables), [&](const std::string& name) {
    return name != demand.error && !is_at_end(name, solution.names);
  });
  return demand;
}

/// Plans a metric-based mesh. The tree is that of the case alone: earlier adaptation demands are discarded.
/// *Collective.*
void plan_by_metric(const Communicator& comm, const MeshInput& input, const AdaptOptions& options,
                    const SolvedMesh& solved, AdaptationPlan& plan) {
  require_norm(options);
  const auto wanted =
      made_from<TargetLevels>(comm, options, solved, finest_of_leaves(input, options, solved));
  require_at_nodes(options, solved, "mesh.type = \"metric\"");
  plan.estimate = wanted.error();
  plan.estimates_of_cells = wanted.of_cells(0);
  if (wanted.flat()) {
    plan.reason_for_no_change = "no variable has a second derivative";
    return;
  }
  const std::int64_t nodes = bounded_nodes(options, solved), allowed = allowed_nodes(input.mesh.limit, nodes);
  if (allowed < nodes) plan.warnings.emplace_back(text_of_bound);
  MetricDemand metric = metric_demand(options, solved.solution);
  metric.nodes = allowed;
  metric.min = options.min.value_or(input.mesh.size.min);
  metric.facets = options.facets;
  plan.anisotropy = std::move(metric);
}

}  // namespace

AdaptationPlan plan_adaptation(const Communicator& comm, const MeshInput& input, const AdaptOptions& options,
                               const SolvedMesh& solved) {
  const progress::SharedStage stage(comm, "planning");
  AdaptationPlan plan;
  plan.transfer = options.transfer;
  FollowedWakes wakes = wakes_to_follow(comm, input, solved);
  plan.warnings = std::move(wakes.warnings);
  plan.measured.walls = wall_to_follow(comm, input, options, solved);
  plan.measured.wakes = std::move(wakes.paths);
  plan.measured.thickness = thickness_to_follow(comm, input, solved, plan.warnings);
  plan.new_layers = other_heights(input, solved.tree.measured, plan.measured) ||
                    other_wakes(input, solved.tree.measured, plan.measured);
  const TrialCount count(comm, input, plan.measured);
  const std::vector<std::int8_t> finest = finest_of_leaves(input, options, solved);
  if (input.mesh.type == MeshType::metric)
    plan_by_metric(comm, input, options, solved, plan);
  else if (options.norm)
    plan_by_sizes(comm, options, solved, count, finest, input.mesh.mirror, plan);
  else
    plan_by_flags(comm, input, options, solved, count, finest, plan);
  if (input.stretch && !plan.flat) plan.anisotropy = target_demand(input, options, solved);
  if (!plan.changes_mesh())
    plan.warnings.push_back("no cell is refined or coarsened, because " + plan.reason_for_no_change);
  return plan;
}

void require_min_in_tree(const MeshInput& input, const AdaptOptions& options) {
  finest_level(input, options);
  const double max = input.mesh.size.max;
  if (input.mesh.type != MeshType::metric || !options.min || *options.min <= max) return;
  throw InputError(
      fmt::format("adapt.min = {} is above the largest size, spacing.max = {}, which leaves the metric no "
                  "size to choose; make "
                  "adapt.min smaller",
                  *options.min, max));
}

void require_room_for_metric(const Communicator& comm, const MeshInput& input, const AdaptOptions& options,
                             const MeshResult& first) {
  if (input.mesh.type != MeshType::metric || !options.max_nodes) return;
  if (*options.max_nodes >= first.tree.attributes.nodes || has_layers(first.mesh)) return;
  const std::int64_t least =
      least_nodes_of_metric(comm, input, options.min.value_or(input.mesh.size.min), first);
  if (*options.max_nodes >= least) return;
  throw InputError(fmt::format(
      "adapt.max_nodes = {} leaves no nodes for anisotropic cells: the case's own sizes need {} nodes; set "
      "at least {}, preferably twice that, or increase spacing.max and the spacings of the boundaries",
      *options.max_nodes, least, least));
}

}  // namespace quadloop::adapt
