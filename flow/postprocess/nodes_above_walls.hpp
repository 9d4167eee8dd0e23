#pragma once

#include <vector>

#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::flow {

/// For each owned wall node the neighbour in the direction closest to the wall normal.
struct NodesAboveWalls {
  std::vector<double> heights;  ///< along the normal; 0 off walls, or if no neighbour is on that side
  std::vector<NodeId> nodes;    ///< if the height is above 0: the neighbour, in the halo mesh
  std::vector<Point> inward;    ///< unit normal averaged over the node's wall edges; 0 off walls
};

/// `is_wall` has an entry for each of the mesh's boundaries. At the root of a wake, whose averaged normal
/// points along the wake, height, neighbour and normal are those above one of the node's wall edges: the
/// lower height counts. `strips` are those of the mesh.
NodesAboveWalls nodes_above(const HaloMesh& mesh, const std::vector<char>& is_wall,
                            const std::vector<StripLayers>& strips);

}  // namespace quadloop::flow
