#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/communicator.hpp"
#include "smoother/node_stars.hpp"

namespace quadloop {

/// Colours for the nodes that may move: no two that share a cell have the same, so that all nodes of one colour can move at once. Nodes choose, in an
/// order that their global numbers alone decide, the first colour that no neighbour before them has (Jones and Plassmann 1993).
struct Colouring {
  std::vector<std::int8_t> colour_of;  ///< of each node of the halo mesh; none for those that stay
  std::int8_t count = 0;               ///< over all ranks
  static constexpr std::int8_t none = -1;
};

/// *Collective.*
Colouring colour_nodes(const Communicator& comm, const HaloMesh& mesh, const NodeStars& stars);

}  // namespace quadloop
