#pragma once

#include <span>

#include "mesher/mesh/halo_mesh.hpp"
#include "smoother/outline/boundary_slide.hpp"

namespace quadloop {

/// Slides boundary nodes on segments with a height (see SmoothOptions) towards the midpoint of their
/// neighbours, so that cell widths vary smoothly. Angles stay above 28 degrees, or above their present value
/// where that is smaller. The result has the same bits on any number of ranks. Returns whether any node has
/// moved. *Collective.*
bool even_widths(const Communicator& comm, HaloMesh& mesh, const BoundarySlide& slide,
                 std::span<const double> heights, int sweeps);

}  // namespace quadloop
