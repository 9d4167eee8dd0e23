#include "adapt/remesh/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

#include "adapt/remesh/followed_walls.hpp"
#include "adapt/remesh/mark_family.hpp"
#include "adapt/remesh/mirrored_leaves.hpp"
#include "adapt/remesh/restart.hpp"
#include "mesher/base/error.hpp"
#include "mesher/build/mesh_estimate.hpp"
#include "mesher/generate/mesh_trial.hpp"

namespace quadloop {

namespace {

/// Looks along the family for the marks that lead to a number of nodes from 95 to 100 % of the one allowed.
class NodeSearch {
 public:
  NodeSearch(const Communicator& comm, const MeshInput& input, const MeasuredWall& measured,
             const SolvedMesh& solved, const MarkFamily& family, int finest)
      : comm_{comm},
        trial_{input, measured},
        limit_{input.mesh.limit},
        solved_{solved},
        family_{family},
        finest_{finest},
        mirror_{input.mesh.mirror} {}

  ChangedSplits changes_at(double at) const {
    ChangedSplits changes = changed_splits(comm_, solved_.tree, family_.marks(at), finest_);
    if (mirror_)  // the last mesh may be one without
      changes.demands = with_images(*mirror_, solved_.tree.attributes, std::move(changes.demands));
    return changes;
  }

  /// As many as no mesh has where the mesh would not be allowed.
  NodeBounds nodes_after(const ChangedSplits& changes) const {
    try {
      return trial_.nodes(comm_, DemandedSplits(comm_, changes.demands));
    } catch (const TooManyCells&) {  // by an estimate that all ranks make
      return {beyond, beyond};
    }
  }

  bool allowed(const ChangedSplits& changes) const { return share_after(changes) <= 1; }

  /// The largest meshes within the cap and within what is allowed, as far as they are found; the one of the
  /// fewest nodes where none is. Without a cap estimates do.
  ChangedSplits within(const std::optional<std::int64_t>& most, ChangedSplits all) const {
    constexpr double enough = 0.95;
    constexpr int most_steps = 24;
    if (filled(most, all).most <= 1) return all;
    double low = -1, high = 1;
    ChangedSplits best = changes_at(low);
    for (int step = 0; step < most_steps; ++step) {
      const double middle = 0.5 * (low + high);
      ChangedSplits tried = changes_at(middle);
      const Share share = filled(most, tried);
      const bool fits = share.most <= 1;
      (fits ? low : high) = middle;
      if (fits) best = std::move(tried);
      if (fits && share.least >= enough) break;
    }
    return best;
  }

  static constexpr std::int64_t beyond = std::numeric_limits<std::int64_t>::max();

 private:
  /// Of cap and limit, what is used up of the one that is nearer to it, at least and at most; above 1: too
  /// many.
  struct Share {
    double least = 0, most = 0;
  };
  Share filled(const std::optional<std::int64_t>& most, const ChangedSplits& changes) const {
    const double of_limit = share_after(changes);
    if (!most || of_limit > 1) return {of_limit, of_limit};
    const NodeBounds nodes = nodes_after(changes);
    const auto cap = static_cast<double>(*most);
    return {std::max(of_limit, static_cast<double>(nodes.least) / cap),
            std::max(of_limit, static_cast<double>(nodes.most) / cap)};
  }

  double share_after(const ChangedSplits& changes) const {
    return share_of(limit_, trial_.estimate(DemandedSplits(comm_, changes.demands)));
  }

  const Communicator& comm_;
  MeshTrial trial_;
  MeshLimit limit_;
  const SolvedMesh& solved_;
  const MarkFamily& family_;
  int finest_;
  std::optional<MirrorAxis> mirror_;
};

int finest_level(const MeshInput& input, const AdaptOptions& options) {
  const Lattice lattice = choose_root(input.geometry, input.mesh.size.root);
  return options.min ? lattice.finest_level(*options.min, "adapt.min")
                     : lattice.finest_level(input.mesh.size.min);
}

/// Why a plan changes no leaf, for its user. `all` is what the rule marks by itself. *Collective.*
std::string reason_for_standing(const Communicator& comm, const AdaptOptions& options,
                                const SolvedMesh& solved, const MarkFamily& family,
                                const ChangedSplits& all) {
  if (family.flat())
    return fmt::format("{} is constant",
                       options.variables.size() == 1 ? options.variables.front() : "each of adapt.variable");
  if (all.refined + all.coarsened > 0)
    return fmt::format("{} leaves no room", options.max_nodes
                                                ? fmt::format("adapt.max_nodes = {}", *options.max_nodes)
                                                : "--max-cells or free memory");
  const std::vector<Mark> marks = family.marks(1);
  const std::int64_t wanted = count_of(comm, marks, Mark::refine);
  if (wanted == 0 && options.source == AdaptOptions::Source::size)
    return "no leaf is larger than " + options.variables.front() + " asks for there";
  if (wanted == 0)
    return "no leaf is above the threshold adapt.refine, and none below adapt.coarsen had been split by "
           "adaptation";
  const std::string bound =
      options.min ? fmt::format("adapt.min = {}", *options.min) : "spacing.min, as adapt.min is not set,";
  std::int8_t coarsest = Quadrant::unit_level;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (marks[i] == Mark::refine) coarsest = std::min(coarsest, solved.tree.leaves[i].level);
  }
  const double edge = solved.tree.attributes.tree_edge /
                      static_cast<double>(std::int64_t{1} << comm.minimum(std::int64_t{coarsest}));
  return fmt::format("{} lets none of the {} leaves above the threshold be split, of edges up to {}", bound,
                     wanted, edge);
}

/// What is wrong with the field is told with its file. *Collective.*
MarkFamily family_of(const Communicator& comm, const AdaptOptions& options, const SolvedMesh& solved,
                     std::optional<MirrorAxis> mirror) {
  try {
    return {comm, options, solved, mirror};
  } catch (const InputError& fault) {  // the same one on every rank
    throw InputError(solved.file.empty() ? fault.what() : solved.file + ": " + fault.what());
  }
}

}  // namespace

AdaptationPlan plan_adaptation(const Communicator& comm, const MeshInput& input, const AdaptOptions& options,
                               const SolvedMesh& solved) {
  const MarkFamily family = family_of(comm, options, solved, input.mesh.mirror);
  AdaptationPlan plan;
  plan.transfer = options.transfer;
  plan.measured_wall = wall_to_follow(comm, input, options, solved);
  plan.new_heights = other_heights(input, solved.tree.measured_wall, plan.measured_wall);
  const NodeSearch search(comm, input, plan.measured_wall, solved, family, finest_level(input, options));
  const ChangedSplits all = search.changes_at(1);
  ChangedSplits changes = all;
  const bool bounded = !search.allowed(all);
  if (bounded) {
    plan.warnings.emplace_back(
        "the mesh is kept to what --max-cells or free memory allows: fewer leaves are refined than are "
        "marked");
  }
  if (options.max_nodes || bounded) changes = search.within(options.max_nodes, all);
  if (options.max_nodes) {
    const auto [least, nodes] = search.nodes_after(changes);
    if (nodes > *options.max_nodes && nodes != NodeSearch::beyond) {
      plan.warnings.push_back(fmt::format(
          "the mesh has {}{} nodes where adapt.max_nodes allows {}: case and geometry alone ask for them",
          least < nodes ? "up to " : "", nodes, *options.max_nodes));
    }
  }
  plan.refined = changes.refined;
  plan.coarsened = changes.coarsened;
  if (!plan.changes_mesh()) {
    plan.reason_for_standing = reason_for_standing(comm, options, solved, family, all);
    plan.warnings.push_back("no leaf is marked, the mesh stays: " + plan.reason_for_standing);
  }
  plan.demands = std::move(changes.demands);
  plan.mean = family.mean();
  plan.deviation = family.deviation();
  return plan;
}

}  // namespace quadloop
