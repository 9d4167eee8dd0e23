#pragma once

#include <vector>

#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// The nodes of each two boundaries of which one is the other's image under a translation or a rotation, node
/// by node to 1e-9 of the mesh's extent, with the domain on the other side: periodic sides of a mesh from a
/// format that has no mark for them. Boundaries that are closed or in several parts have no image. Ascending.
/// O(n log n) in the boundary's edges.
std::vector<NodeId> nodes_of_matching_sides(const Mesh& mesh);

}  // namespace quadloop
