#include "adapt/remesh/demands/target_levels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "adapt/remesh/demands/mirrored_leaves.hpp"
#include "adapt/sensor/cells_of_leaves.hpp"
#include "adapt/sensor/interpolation_error.hpp"
#include "adapt/sensor/solver_error.hpp"
#include "adapt/sensor/target_size.hpp"
#include "generate/leaf_quadrant.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"

namespace quadloop::adapt {

namespace {

/// Demands the splits of all quadrants of level `level` - 1 in the quadtree cell, or of the one that contains
/// it.
void demand_level(const Quadrant& leaf, int level, std::vector<SplitDemand>& demands) {
  const int split = level - 1;
  const std::uint32_t mask = 1U << split;
  if (split <= leaf.level) {
    demands.push_back({leaf, mask});
    return;
  }
  const std::int64_t edge = std::int64_t{1} << (Quadrant::unit_level - split);
  const std::int64_t count = std::int64_t{1} << (split - leaf.level);
  for (std::int64_t row = 0; row < count; ++row) {
    for (std::int64_t column = 0; column < count; ++column)
      demands.push_back(
          {{leaf.x + column * edge, leaf.y + row * edge, static_cast<std::int8_t>(split)}, mask});
  }
}

}  // namespace

ChangedSplits splits_for_levels(const Communicator& comm, const TreeRecord& tree,
                                std::span<const std::int8_t> levels) {
  QUADLOOP_REQUIRE(levels.size() == tree.leaves.size(), "there must be one level for each leaf",
                   levels.size(), tree.leaves.size());
  ChangedSplits changed;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const LeafRecord& leaf = tree.leaves[i];
    if (levels[i] > 0) demand_level(quadrant_of(leaf), levels[i], changed.demands);
    if (levels[i] > leaf.level) ++changed.refined;
  }
  const DemandedSplits demanded(comm, changed.demands);
  DemandPath path(demanded);
  for (const LeafRecord& leaf : tree.leaves) {
    if (leaf.level == 0) continue;
    const std::uint32_t parent = 1U << (leaf.level - 1);
    const Quadrant square = quadrant_of(leaf);
    if ((leaf.adapted & parent) != 0 && (path.levels_above(square) & parent) == 0) ++changed.coarsened;
  }
  changed.refined = comm.sum(changed.refined);
  changed.coarsened = comm.sum(changed.coarsened);
  return changed;
}

TargetLevels::TargetLevels(const Communicator& comm, const AdaptOptions& options, const SolvedMesh& solved,
                           std::vector<std::int8_t> finest, std::optional<MirrorAxis> mirror)
    : comm_{comm}, tree_{solved.tree}, finest_{std::move(finest)}, mirror_{mirror}, norm_{*options.norm} {
  QUADLOOP_REQUIRE(finest_.size() == tree_.leaves.size(), "there must be one finest level for each leaf",
                   finest_.size(), tree_.leaves.size());
  const Field field = selected(solved.solution, options.variables, "adapt.variable");
  by_error_ = options.source == AdaptOptions::Source::error;
  InterpolationError error =
      by_error_ ? solver_error(comm, solved.mesh, field) : interpolation_error(comm, solved.mesh, field);
  error_ = norm_of(comm, error, by_error_ ? 1 : norm_);  // an error is the sum of its parts
  cell_densities_ = cell_densities(error, norm_);
  densities_ = CellsOfLeaves(comm, solved.mesh, tree_.leaves).largest(comm, cell_densities_);
  if (mirror_) agree_with_images(comm, *mirror_, tree_, OfImages::larger, densities_);
  std::vector<double> terms;
  for (std::size_t i = 0; i < cell_densities_.size(); ++i)
    terms.push_back(error.areas[i] * cell_densities_[i]);
  total_ = reproducible_sum(comm, terms);
  cell_errors_ = std::move(error.mean);
}

CellValues TargetLevels::of_cells(double complexity) const {
  const char* const name = by_error_ ? "error_density" : "interpolation_error";
  CellValues cells{{name}, cell_errors_};
  if (complexity == 0) return cells;
  cells = {{name, "wanted_size"}, {}};
  for (std::size_t i = 0; i < cell_errors_.size(); ++i) {
    const double size = std::sqrt(total_ / (complexity * cell_densities_[i]));
    cells.values.push_back(cell_errors_[i]);
    cells.values.push_back(std::min(size, tree_.attributes.tree_edge));
  }
  return cells;
}

std::vector<std::int8_t> TargetLevels::levels(double complexity) const {
  std::vector<std::int8_t> levels;
  for (std::size_t i = 0; i < densities_.size(); ++i) {
    const double density = densities_[i];
    const double edge = std::sqrt(total_ / (complexity * density));  // infinite if no size is requested
    const bool none = !(complexity * density > 0);
    levels.push_back(static_cast<std::int8_t>(
        none ? 0 : std::min<int>(level_for_size(tree_.attributes.tree_edge, edge), finest_[i])));
  }
  return levels;
}

ChangedSplits TargetLevels::changes(double complexity) const {
  ChangedSplits changes = splits_for_levels(comm_, tree_, levels(complexity));
  if (mirror_) changes.demands = with_images(*mirror_, tree_.attributes, std::move(changes.demands));
  return changes;
}

double TargetLevels::leaves_at(double complexity) const {
  const std::vector<std::int8_t> wanted = levels(complexity);
  std::vector<double> leaves;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    leaves.push_back(std::ldexp(1.0, 2 * (wanted[i] - tree_.leaves[i].level)));
  return reproducible_sum(comm_, leaves);
}

namespace {

/// Returns the next complexity to try, assuming nodes proportional to complexity, but between the known
/// bounds.
double next_complexity(double tried, double nodes, double wanted, double low, double high) {
  constexpr double far = 8;
  const double least = low > 0 ? low : tried / far, most = std::isfinite(high) ? high : tried * far;
  const double guess = tried * wanted / nodes;
  const bool inside = guess > least * 1.001 && guess < most * 0.999;
  return inside ? guess : std::sqrt(least * most);
}

}  // namespace

SizedChanges changes_for_nodes(const TargetLevels& wanted, const TrialCount& count, std::int64_t nodes) {
  constexpr double enough = 0.95, aim = 0.975;
  constexpr int most_steps = 16;
  const auto cap = static_cast<double>(nodes);
  SizedChanges best{wanted.changes(0), 0, false};
  bool bounded = false;
  if (wanted.flat()) return best;
  double low = 0, high = std::numeric_limits<double>::infinity(), tried = cap;
  for (int step = 0; step < most_steps; ++step) {
    const double leaves = wanted.leaves_at(tried);
    if (leaves > 8 * cap) {  // most of these cells have nodes: generating the mesh is not worthwhile
      high = tried;
      tried = next_complexity(tried, leaves, cap, low, high);
      continue;
    }
    SizedChanges now{wanted.changes(tried), tried, false};
    bounded = bounded || !count.allowed(now.changes);
    const TrialCount::Share share = count.filled(nodes, now.changes);
    const bool fits = share.most <= 1;
    (fits ? low : high) = tried;
    if (fits) best = std::move(now);
    if (fits && share.least >= enough) break;
    // The number of nodes is a step function: secant steps alternate with bisection.
    const bool by_secant = step < 2 || step % 2 == 0;
    tried = next_complexity(tried, by_secant ? share.most * cap : 0, aim * cap, low, high);
  }
  constexpr double near = 0.8;  // otherwise only a step of the search exceeded the limit
  best.bounded = bounded && count.share_of_limit(best.changes) > near;
  return best;
}

}  // namespace quadloop::adapt
