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

namespace quadloop {

/// What a saved tree is to be split at for each of this rank's leaves to become leaves of a level of its own,
/// or to lie in one: whatever was asked for before counts no more. A leaf that is to be finer by n levels
/// becomes 4^n. `levels` has one entry for each leaf; 0 asks for nothing. *Collective.*
ChangedSplits splits_for_levels(const Communicator& comm, const TreeRecord& tree,
                                std::span<const std::int8_t> levels);

/// The sizes that make the L^p norm of the interpolation error, or of a solver's own, least, for more or
/// fewer nodes.
class WantedLevels {
 public:
  /// From the variables of the options, whose norm must be given. `solved` must outlive it. Throws InputError
  /// where the solution has no such variable, or one that is not finite. With a mirror axis leaves that are
  /// each other's images want the same. `finest` has one level for each leaf of this rank's share.
  /// *Collective.*
  WantedLevels(const Communicator& comm, const AdaptOptions& options, const SolvedMesh& solved,
               std::vector<std::int8_t> finest, std::optional<MirrorAxis> mirror = {});

  /// Whether all variables are linear, which asks for no sizes.
  bool flat() const { return !(total_ > 0); }
  /// The L^p norm of the error, of a solver's own the sum of its parts, on the mesh that was solved on.
  double error() const { return error_; }
  /// For each cell its error, and the size wanted there at this complexity; at 0 without the
  /// sizes, and at most the edge of a tree.
  CellValues of_cells(double complexity) const;

  /// The level wanted of each of this rank's leaves, none finer than its finest, for sizes h of which the
  /// integral of 1 / h^2 is `complexity`.
  std::vector<std::int8_t> levels(double complexity) const;
  /// The changes that lead to these. *Collective.*
  ChangedSplits changes(double complexity) const;
  /// How many leaves these levels come to over all ranks, but for those that gradation adds. *Collective.*
  double leaves_at(double complexity) const;

 private:
  const Communicator& comm_;
  const TreeRecord& tree_;
  std::vector<std::int8_t> finest_;
  std::optional<MirrorAxis> mirror_;
  double norm_;
  bool by_error_ = false;  ///< by a solver's own error, not by what interpolation loses
  double error_ = 0, total_ = 0;
  std::vector<double> densities_;  ///< of leaves: the largest of their cells
  std::vector<double> cell_errors_, cell_densities_;
};

/// Changes that lead to a number of nodes, and the complexity of the sizes that they follow.
struct SizedChanges {
  ChangedSplits changes;
  double complexity = 0;
  bool bounded = false;  ///< --max-cells or free memory has kept them below the number wanted
};

/// Looks for the complexity that leads to 95 to 100 % of so many nodes; as leaves change by factors of two
/// there may be none: then the most nodes that were found within the cap, and what case and geometry alone
/// ask for where that is more. *Collective.*
SizedChanges changes_for_nodes(const WantedLevels& wanted, const TrialCount& count, std::int64_t nodes);

}  // namespace quadloop
