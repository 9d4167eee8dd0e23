#pragma once

#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::io {

/// Returns the nodes, ascending, of each two boundaries that are images of each other under a translation or
/// a rotation, node by node to 1e-9 of the mesh's extent, with the domain on opposite sides: periodic sides
/// of a mesh in a format that cannot mark them. Boundaries that are closed or in several parts have no image.
/// O(n log n) in the boundary edges.
std::vector<NodeId> nodes_of_matching_sides(const Mesh& mesh);

/// The same of a distributed mesh: those that this rank owns. The root compares the boundaries. *Collective.*
std::vector<NodeId> nodes_of_matching_sides(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop::io
