#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "adapt/sensor/thresholds.hpp"
#include "generate/generate.hpp"
#include "mesher/mesh/tree_record.hpp"
#include "mesher/sizes/demanded_splits.hpp"

namespace quadloop {

/// The square of a leaf, among those of all trees.
Quadrant quadrant_of(const LeafRecord& leaf);

/// What adaptation has asked of this rank's share of a saved tree; with it, the same case and geometry give
/// the same tree again.
std::vector<SplitDemand> adapted_splits(const TreeRecord& tree);

/// The same, and that every leaf's wanted level stands, whatever case and geometry ask for now.
std::vector<SplitDemand> wanted_splits(const TreeRecord& tree);

/// What a saved tree asks of a restart with this input: its wanted levels stand where the geometry is the one
/// that it was made for; for another geometry, what adaptation asked for.
std::vector<SplitDemand> standing_splits(const TreeRecord& tree, const MeshInput& input);

/// Demands after marks, and how many marks took effect over all ranks.
struct ChangedSplits {
  std::vector<SplitDemand> demands;
  std::int64_t refined = 0, coarsened = 0;  ///< leaves to be split; leaves that are to go
};

/// One cycle's change. A leaf marked to be refined is split, unless it is of the finest level given for it.
/// Four siblings that are all marked to be coarsened become one again where adaptation had split it: what
/// case, geometry and gradation ask for stays, and the same marks take back what they made. A leaf without
/// cells, which nothing marks, goes with its siblings wherever some leaf is coarsened. `marks` has one entry
/// for each leaf of this rank's share. *Collective.*
ChangedSplits changed_splits(const Communicator& comm, const TreeRecord& tree, std::span<const Mark> marks,
                             std::span<const std::int8_t> finest_levels);

/// Keeps the root of a saved tree: sets the option where the geometry would now choose another. Throws
/// InputError where the geometry does not lie in it.
void keep_root(const TreeAttributes& tree, MeshInput& input);

}  // namespace quadloop
