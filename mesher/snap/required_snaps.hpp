#pragma once

#include <span>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/snap/snap.hpp"

namespace quadloop {

/// The snaps that make points of the domain nodes: each point moves the nearest grid vertex, or bends the
/// nearest grid edge, or becomes a node inside its leaf. The leaf and those around it must contain no
/// geometry and no other point. Each point is decided on the rank of its leaf. The same on all ranks.
/// *Collective.*
std::vector<Snap> required_snaps(const Communicator& comm, const LeafGraph& graph, const TreeGrid& grid,
                                 std::span<const Point> points);

}  // namespace quadloop
