#pragma once

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Locations of the worst cells of a mesh; the first in the order of the cells if there are several.
struct WorstPlaces {
  Point smallest_angle, largest_angle;  ///< the corners
  Point worst_quality;                  ///< the mean of the cell's nodes
};

/// The places of cells outside layers; `places` is empty if there are none. The mesh must have valid node
/// numbers. Linear in time. Independent of the number of ranks. *Collective.*
WorstPlaces worst_places(const Communicator& comm, const Mesh& mesh, const LayerPlaces& places);

}  // namespace quadloop
