#pragma once

#include <optional>

#include "mesher/build/build_mesh.hpp"

namespace quadloop {

/// Returns the geometry without the loops whose bounding boxes are smaller than `min` in both directions, and
/// without their interior; each is counted and named in the report. Throws InputError if no loop remains.
Geometry without_small_islands(const Geometry& geometry, double min, MeshReport& report);

/// The same, but empty if all loops remain, to avoid a copy of a large geometry.
std::optional<Geometry> small_islands_dropped(const Geometry& geometry, double min, MeshReport& report);

}  // namespace quadloop
