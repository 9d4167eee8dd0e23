#pragma once

#include <functional>

#include "smoother/smooth_mesh.hpp"

namespace quadloop::smoother {

/// Smooths a mesh that is mirror-symmetric in the axis `options.mirror` and keeps it exactly symmetric:
/// `smooth_half` smooths one side, whose nodes slide along the axis, and the other side becomes its image.
/// The report is that of the half, except for `standing`. Throws InputError with coordinates if a node or, in
/// a Delaunay mesh, a cell has no mirror image. *Collective.*
SmoothReport smooth_mirrored(
    const Communicator& comm, Mesh& mesh, const SmoothOptions& options,
    const std::function<SmoothReport(Mesh& half, const SmoothOptions& options)>& smooth_half);

}  // namespace quadloop::smoother
