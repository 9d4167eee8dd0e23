#pragma once

#include "mesher/geometry/geometry.hpp"

namespace quadloop::adapt {

/// Returns the geometry with those short bases merged whose ends are one node of the mesh: no vertex of the
/// mesh boundary `outline` lies on either end, but one lies at merged_end().
Geometry with_bases_as_in(const Geometry& outline, const Geometry& geometry);

}  // namespace quadloop::adapt
