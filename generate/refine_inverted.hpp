#pragma once

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/build/build_mesh.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/sizes/demanded_splits.hpp"

namespace quadloop {

/// How often the mesh is made again from smaller cells at curves. Much smaller ones do not help: the chords
/// of the curves, on which the geometry is cut, follow them within a share of spacing.min only.
inline constexpr int most_refined_curves = 2;

/// Refines the next mesh where cells of this one are inverted or flat, because their boundary nodes have
/// moved from a chord onto its curve: the quadtree cells of the boundary edges there are split, below
/// spacing.min if necessary. Returns whether there is such a cell at a boundary edge; there is none without
/// curves. *Collective.*
bool refine_inverted(const Communicator& comm, const Geometry& geometry, const MeshResult& result,
                     DemandedSplits& splits);

/// Throws InputError on all ranks, with place and remedy, if the geometry has curves and the mesh has such a
/// cell. *Collective.*
void require_not_inverted(const Communicator& comm, const Geometry& geometry, const Mesh& mesh);

}  // namespace quadloop
