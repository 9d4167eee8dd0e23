#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/layers/front/layer_front.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// An edge of the mesh outside on which no layers can stand.
struct UnsoundStrip {
  std::array<NodeId, 2> edge;
  std::int32_t leaf = 0;               ///< of the edge
  std::vector<std::int32_t> stations;  ///< between the columns at its ends; may be none
};

/// Those of this rank's edges where a cell between the columns would not be positive, where the wall is
/// farther from the chord between the columns' feet than half the chord's length, where that chord meets
/// another one, or at a node in which two stretches of the front touch. Fans are not looked at. `edge_leaves`
/// as MeshResult has them. *Collective.*
std::vector<UnsoundStrip> unsound_strips(const Communicator& comm, const LayerFront& front, const Mesh& outer,
                                         const std::vector<std::vector<std::int32_t>>& edge_leaves);

}  // namespace quadloop
