#pragma once

#include <span>

#include "mesher/mesh/halo_mesh.hpp"
#include "smoother/outline/boundary_slide.hpp"

namespace quadloop::smoother {

/// Moves nodes beside the front of layers where the cells there are much lower or higher than the layers'
/// last one, or where widths jump along the front: a few rings of nodes outside follow the front's own, which
/// go on towards the middle of their neighbours. No angle falls under 28 degrees, or under the smallest one
/// in a node's star. `heights`: of the last layer at each segment of the outline, 0 where it is no front. The
/// same bits on any number of ranks. *Collective.* Returns whether any node has moved.
bool fit_to_layers(const Communicator& comm, HaloMesh& mesh, BoundarySlide& slide,
                   std::span<const double> heights);

}  // namespace quadloop::smoother
