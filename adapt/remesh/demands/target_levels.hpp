#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "adapt/remesh/demands/adapt_options.hpp"
#include "adapt/remesh/demands/restart.hpp"
#include "adapt/remesh/demands/solved_mesh.hpp"
#include "adapt/remesh/demands/trial_count.hpp"
#include "mesher/geometry/mirror_axis.hpp"

namespace quadloop::adapt {

/// Returns the splits of a saved tree that bring each quadtree cell of this rank to its own target level;
/// earlier demands are discarded. A cell that is to be n levels finer becomes 4^n cells. `levels` has one
/// entry for each cell; 0 requests nothing. *Collective.*
ChangedSplits splits_for_levels(const Communicator& comm, const TreeRecord& tree,
                                std::span<const std::int8_t> levels);

/// Target sizes that minimise the L^p norm of the interpolation error, or of the solver's own error field,
/// for a variable number of nodes.
class TargetLevels {
 public:
  /// Uses the variables of the options, whose norm must be given. `solved` must outlive the object. With a
  /// mirror axis mirror images get the same size. `finest` has one level for each quadtree cell of this rank.
  /// Throws InputError if the solution has no such variable, or one that is not finite. *Collective.*
  TargetLevels(const Communicator& comm, const AdaptOptions& options, const SolvedMesh& solved,
               std::vector<std::int8_t> finest, std::optional<MirrorAxis> mirror = {});

  /// Whether all variables are linear, so that no size is requested.
  bool flat() const { return !(total_ > 0); }
  /// Returns the L^p norm of the interpolation error, or the sum of the solver's own error, on the solved
  /// mesh.
  double error() const { return error_; }
  /// Returns the error and the target size of each cell at this complexity; sizes are at most the edge of a
  /// tree. At complexity 0 only the errors.
  CellValues of_cells(double complexity) const;

  /// Returns the target level of each quadtree cell of this rank, limited to its finest level, for sizes h
  /// with integral(1 / h^2) = `complexity`.
  std::vector<std::int8_t> levels(double complexity) const;
  /// Returns the changes that lead to these levels. *Collective.*
  ChangedSplits changes(double complexity) const;
  /// Returns the number of quadtree cells at these levels over all ranks, without those added by gradation.
  /// *Collective.*
  double leaves_at(double complexity) const;

 private:
  const Communicator& comm_;
  const TreeRecord& tree_;
  std::vector<std::int8_t> finest_;
  std::optional<MirrorAxis> mirror_;
  double norm_;
  bool by_error_ = false;  ///< whether the error is the solver's own field
  double error_ = 0, total_ = 0;
  std::vector<double> densities_;  ///< of quadtree cells: the maximum over their mesh cells
  std::vector<double> cell_errors_, cell_densities_;
};

/// Changes that lead to a number of nodes, and the complexity of their target sizes.
struct SizedChanges {
  ChangedSplits changes;
  double complexity = 0;
  bool bounded = false;  ///< whether --max-cells or free memory keeps them below the requested number
};

/// Searches for the complexity that gives 95 to 100 % of `nodes`. As cells change by factors of two there may
/// be none: the result is then the most nodes found within the cap, or what case and geometry alone require
/// if that is more. *Collective.*
SizedChanges changes_for_nodes(const TargetLevels& wanted, const TrialCount& count, std::int64_t nodes);

}  // namespace quadloop::adapt
