#pragma once

#include <vector>

#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop {

/// What stands above the owned nodes of walls: of each owned node the neighbour in the direction nearest to
/// the walls' normal.
struct NodesAboveWalls {
  std::vector<double> heights;  ///< along the normal; 0 where no neighbour lies on that side, or off walls
  std::vector<NodeId> nodes;    ///< where the height is above 0: the neighbour, of the halo mesh
  std::vector<Point> inward;    ///< the unit normal of the node's wall edges together; 0 off walls
};

/// `is_wall` has an entry for each of the mesh's boundaries.
NodesAboveWalls nodes_above(const HaloMesh& mesh, const std::vector<char>& is_wall);

}  // namespace quadloop
