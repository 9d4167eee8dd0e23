#pragma once

#include <cstdint>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop::adapt {

/// Returns the finest level to which adaptation may split each quadtree cell of this rank: `finest`, but at
/// facets of the geometry (FacetZones) cells do not become smaller than half of the segments there, unless
/// the facets may be resolved. Peaks of the solution at polygon points are artefacts that the curve itself
/// does not have.
std::vector<std::int8_t> finest_levels(const Geometry& geometry, const TreeRecord& tree, int finest,
                                       bool facets_may_be_resolved);

}  // namespace quadloop::adapt
