#pragma once

#include <span>

#include "mesher/mesh/halo_mesh.hpp"
#include "smoother/outline/boundary_slide.hpp"

namespace quadloop::smoother {

/// Slides boundary nodes on segments of the outline with a height (see SmoothOptions) towards the middle of
/// their neighbours, so that the widths of cells change little from one to the next; angles stay above 28
/// degrees or what they are. The same bits on any number of ranks. *Collective.* Returns whether any node has
/// moved.
bool even_widths(const Communicator& comm, HaloMesh& mesh, BoundarySlide& slide,
                 std::span<const double> heights, int sweeps);

}  // namespace quadloop::smoother
