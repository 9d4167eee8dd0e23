#pragma once

#include <span>

#include "mesher/mesh/halo_mesh.hpp"
#include "smoother/outline/boundary_slide.hpp"

namespace quadloop {

/// Moves nodes beside the outer edge of the layers where the adjacent cells are much lower or higher than the
/// last layer, or where cell widths jump along the edge. A few rings of outside nodes follow the nodes on the
/// edge, which slide towards the midpoint of their neighbours. No angle falls below 28 degrees, or below the
/// smallest angle in the node's star. `heights`: height of the last layer at each segment of the geometry, 0
/// where no layers end. The result has the same bits on any number of ranks. Returns whether any node has
/// moved. *Collective.*
bool fit_to_layers(const Communicator& comm, HaloMesh& mesh, const BoundarySlide& slide,
                   std::span<const double> heights);

}  // namespace quadloop
