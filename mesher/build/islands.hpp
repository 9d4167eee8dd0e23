#pragma once

#include <optional>

#include "mesher/build/build_mesh.hpp"

namespace quadloop {

/// The geometry without the loops whose boxes are smaller than `min` both ways, and without what lies inside
/// those; each is counted and named in the report. Throws InputError where no loop remains.
Geometry without_small_islands(const Geometry& geometry, double min, MeshReport& report);

/// The same, but none where all loops stay: a large geometry need not be held twice.
std::optional<Geometry> small_islands_dropped(const Geometry& geometry, double min, MeshReport& report);

}  // namespace quadloop
