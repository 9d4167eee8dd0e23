#pragma once

#include "mesher/geometry/mirror_axis.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::test {

/// A whole mesh above the axis, and at it, with its mirror image: boundary edges along the axis go.
Mesh with_image(const Mesh& half, MirrorAxis axis);

}  // namespace quadloop::test
