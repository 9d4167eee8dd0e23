#pragma once

#include "mesher/geometry/mirror_axis.hpp"
#include "mesher/snap/leaf_trace.hpp"
#include "mesher/snap/snap.hpp"

namespace quadloop {

/// Chooses the corners to snap: first those that kept points capture (capture_points), then those with a
/// crossing nearer than `share`, at most one half, of the shortest leaf edge there (snap_corner). Each corner
/// is decided alone, from the traces of the leaves around it, so that all ranks which see it decide the same.
/// With a mirror axis corners on it stay on it.
std::vector<Snap> choose_snaps(const LeafGraph& graph, const Lattice& lattice, const Geometry& geometry,
                               const TracedForest& traced, double share,
                               std::optional<MirrorAxis> mirror = {});

}  // namespace quadloop
