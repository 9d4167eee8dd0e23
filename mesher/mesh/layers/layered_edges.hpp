#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// An edge of a wall on which layers stand.
struct LayeredEdge {
  std::array<NodeId, 2> nodes;
  std::int32_t layers = 0;  ///< of which boundary they are: index into Mesh::boundaries
};

/// This rank's: those of boundaries with layers, and those that follow such a one on a boundary without, up
/// to the first corner of 45 to 135 degrees, where a column lies on the next boundary. *Collective.*
std::vector<LayeredEdge> layered_edges(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop
