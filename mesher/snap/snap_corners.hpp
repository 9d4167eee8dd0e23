#pragma once

#include "mesher/geometry/mirror_axis.hpp"
#include "mesher/snap/leaf_trace.hpp"
#include "mesher/snap/snap.hpp"

namespace quadloop {

/// Selects the grid vertices to snap: first those captured by kept points (capture_points), then those with a
/// crossing nearer than `share` (at most one half) of the shortest leaf edge there (snap_corner). Each vertex
/// is decided separately from the traces of the leaves around it, so that all ranks that see it agree. With a
/// mirror axis vertices on it stay on it.
std::vector<Snap> choose_snaps(const LeafGraph& graph, const TreeGrid& grid, const Geometry& geometry,
                               const TracedForest& traced, double share,
                               std::optional<MirrorAxis> mirror = {});

}  // namespace quadloop
