#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adapt/sensor/thresholds.hpp"
#include "generate/generate.hpp"
#include "mesher/mesh/tree_record.hpp"
#include "mesher/sizes/demanded_splits.hpp"

namespace quadloop::adapt {

/// Returns the adaptation splits of this rank's part of a saved tree. With them the same case and geometry
/// give the same tree again.
std::vector<SplitDemand> adapted_splits(const TreeRecord& tree);

/// Returns the adaptation splits, and splits that keep the target level of every cell whatever case and
/// geometry now request.
std::vector<SplitDemand> wanted_splits(const TreeRecord& tree);

/// Returns the demands of a saved tree for a restart with this input: its target levels if the geometry has
/// not changed, else only the adaptation splits.
std::vector<SplitDemand> unchanged_splits(const TreeRecord& tree, const MeshInput& input);

/// Demands after flagging, and the number of flags that took effect over all ranks.
struct ChangedSplits {
  std::vector<SplitDemand> demands;
  std::int64_t refined = 0, coarsened = 0;  ///< cells to be split; cells to be removed
};

/// Applies one cycle's flags. A cell flagged for refinement is split, unless it has reached its finest level.
/// Four siblings that are all flagged for coarsening are merged if adaptation had split their parent; splits
/// by case, geometry and gradation remain, so coarsening flags reverse earlier refinement flags. Empty cells,
/// which are never flagged, are merged with their siblings if any cell is coarsened. `marks` has one entry
/// for each quadtree cell of this rank. *Collective.*
ChangedSplits changed_splits(const Communicator& comm, const TreeRecord& tree,
                             std::span<const RefinementFlag> flags,
                             std::span<const std::int8_t> finest_levels);

/// Keeps the root of a saved tree, by setting the option if the geometry would now imply another. Throws
/// InputError if the geometry does not lie inside it.
void keep_root(const TreeAttributes& tree, MeshInput& input);

}  // namespace quadloop::adapt
