#pragma once

#include <functional>

#include "smoother/smooth_mesh.hpp"

namespace quadloop {

/// Smooths a mesh that is its own mirror image in the axis `options.mirror` and keeps it so, to the last bit:
/// `smooth_half` smooths one side of the axis, along which nodes slide, and the other becomes the image of
/// that. The report is the half's, but for `standing`. Throws InputError, naming the place, where a node has
/// no image, or, of a Delaunay mesh, a cell. *Collective.*
SmoothReport smooth_mirrored(
    const Communicator& comm, Mesh& mesh, const SmoothOptions& options,
    const std::function<SmoothReport(Mesh& half, const SmoothOptions& options)>& smooth_half);

}  // namespace quadloop
