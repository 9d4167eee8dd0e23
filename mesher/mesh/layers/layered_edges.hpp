#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// A wall edge with layers.
struct LayeredEdge {
  std::array<NodeId, 2> nodes;
  std::int32_t layers = 0;  ///< boundary of the layers: index into Mesh::boundaries
};

/// Returns this rank's wall edges with layers: those of boundaries with layers, and those that follow on a
/// boundary without, up to the first corner of 45 to 135 degrees, where a column lies on the next boundary.
/// *Collective.*
std::vector<LayeredEdge> layered_edges(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop
