#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/layers/front/layer_front.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Two neighbouring columns between which a cell would not be positive: their chord of the front, or of the
/// wall, cuts off too much of its bends.
struct InvertedStrip {
  std::array<NodeId, 2> chord;  ///< of the front
  std::int32_t leaf = 0;        ///< of the chord
  std::vector<std::int32_t> stations;  ///< between the columns; may be none
};

/// Those of this rank's chords, of the mesh outside of the layers; `edge_leaves` as MeshResult has them. Fans
/// are not looked at.
std::vector<InvertedStrip> inverted_strips(const LayerFront& front, const Mesh& outer,
                                           const std::vector<std::vector<std::int32_t>>& edge_leaves);

}  // namespace quadloop
