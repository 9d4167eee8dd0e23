#pragma once

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/build/build_mesh.hpp"
#include "mesher/sizes/demanded_splits.hpp"

namespace quadloop {

/// Refines the next mesh where cells of this one are inverted or flat, because their boundary nodes have
/// moved from a chord onto its curve: the quadtree cells of the boundary edges there are split, below
/// spacing.min if necessary. Returns whether there is such a cell at a boundary edge. *Collective.*
bool refine_inverted(const Communicator& comm, const MeshResult& result, DemandedSplits& splits);

}  // namespace quadloop
