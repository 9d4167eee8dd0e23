#include "adapt/plan.hpp"

#include <fmt/format.h>

#include "adapt/mark_family.hpp"
#include "adapt/restart.hpp"

namespace quadloop {

namespace {

/// Looks along the family for the marks that lead to a number of nodes from 95 to 100 % of the one allowed.
class NodeSearch {
 public:
  NodeSearch(const Communicator& comm, const MeshInput& input, const SolvedMesh& solved, const MarkFamily& family, int finest)
      : comm_{comm}, input_{input}, solved_{solved}, family_{family}, finest_{finest} {}

  ChangedSplits changes_at(double at) const { return changed_splits(comm_, solved_.tree, family_.marks(at), finest_); }

  std::int64_t nodes_after(const ChangedSplits& changes) const {
    return build_mesh(comm_, input_.geometry, input_.mesh, DemandedSplits(comm_, changes.demands)).tree.attributes.nodes;
  }

  /// The largest meshes within the cap, as far as they are found; the one of the fewest nodes where none is.
  ChangedSplits within(std::int64_t most, ChangedSplits all) const {
    constexpr double enough = 0.95;
    constexpr int most_steps = 24;
    if (nodes_after(all) <= most) return all;
    double low = -1, high = 1;
    ChangedSplits best = changes_at(low);
    for (int step = 0; step < most_steps; ++step) {
      const double middle = 0.5 * (low + high);
      ChangedSplits tried = changes_at(middle);
      const std::int64_t nodes = nodes_after(tried);
      (nodes <= most ? low : high) = middle;
      if (nodes <= most) best = std::move(tried);
      if (nodes <= most && static_cast<double>(nodes) >= enough * static_cast<double>(most)) break;
    }
    return best;
  }

 private:
  const Communicator& comm_;
  const MeshInput& input_;
  const SolvedMesh& solved_;
  const MarkFamily& family_;
  int finest_;
};

int finest_level(const MeshInput& input, const AdaptOptions& options) {
  const Lattice lattice = choose_root(input.geometry, input.mesh.size.root);
  return options.min ? lattice.finest_level(*options.min, "adapt.min") : lattice.finest_level(input.mesh.size.min);
}

}  // namespace

AdaptationPlan plan_adaptation(const Communicator& comm, const MeshInput& input, const AdaptOptions& options, const SolvedMesh& solved) {
  const MarkFamily family(comm, options, solved);
  const NodeSearch search(comm, input, solved, family, finest_level(input, options));
  ChangedSplits changes = search.changes_at(1);
  AdaptationPlan plan;
  if (options.max_nodes) {
    changes = search.within(*options.max_nodes, std::move(changes));
    const std::int64_t nodes = search.nodes_after(changes);
    if (nodes > *options.max_nodes) {
      plan.warnings.push_back(
          fmt::format("the mesh has {} nodes where adapt.max_nodes allows {}: case and geometry alone ask for them", nodes, *options.max_nodes));
    }
  }
  plan.demands = std::move(changes.demands);
  plan.mean = family.mean();
  plan.deviation = family.deviation();
  plan.refined = changes.refined;
  plan.coarsened = changes.coarsened;
  return plan;
}

}  // namespace quadloop
