#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/layers/front/layer_front.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// An edge of the mesh outside on which no valid layers can be built.
struct UnsoundStrip {
  std::array<NodeId, 2> edge;
  std::int32_t leaf = 0;               ///< leaf of the edge
  std::vector<std::int32_t> stations;  ///< between the columns at its ends; may be empty
};

/// This rank's edges where one of these holds: a cell between the columns is not positive; the wall is
/// farther from the chord between the columns' feet than half the chord's length; that chord meets another
/// one; two stretches of the front touch in a node of the edge. Fans are not checked. `edge_leaves` is as in
/// MeshResult. *Collective.*
std::vector<UnsoundStrip> unsound_strips(const Communicator& comm, const LayerFront& front, const Mesh& outer,
                                         const std::vector<std::vector<std::int32_t>>& edge_leaves);

}  // namespace quadloop
