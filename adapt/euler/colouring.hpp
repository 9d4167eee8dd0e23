#pragma once

#include <cstdint>
#include <vector>

#include "adapt/euler/dual_mesh.hpp"

namespace quadloop::euler {

/// Colours for all nodes, so that no edge joins two of one colour: a relaxation may visit the nodes of a colour at once. Nodes choose, in an order
/// that their numbers over all ranks alone decide, the first colour that no neighbour before them has (Jones and Plassmann 1993).
struct NodeColours {
  std::vector<std::int8_t> colour_of;  ///< of each node; -1 for those that no edge of this rank reaches
  int count = 0;                       ///< over all ranks
};

/// *Collective.*
NodeColours colour_nodes(const Communicator& comm, const DualMesh& mesh);

}  // namespace quadloop::euler
