#pragma once

#include <cstdint>
#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// The finest level to which adaptation may split each leaf of this rank's share of a tree: `finest`, but at
/// facets of the outline (FacetZones) none that makes leaves smaller than half of the segments there, unless
/// they may be resolved. Peaks of the solution at points of a polygon are none of the curve that it stands
/// for.
std::vector<std::int8_t> finest_levels(const Geometry& geometry, const TreeRecord& tree, int finest,
                                       bool facets_may_be_resolved);

}  // namespace quadloop
