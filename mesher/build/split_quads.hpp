#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/delaunay/tie_order.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// Splits each quadrilateral that is not a parallelogram (skew_of() above parallel_skew) into two triangles,
/// by the Delaunay diagonal; for cocircular nodes by that through the node of highest rank. Median-dual
/// schemes are then exact for linear fields at every inner node. The triangles follow those of their leaf,
/// whose counts in `leaves` are updated. Not collective.
void split_skew_quads(Mesh& mesh, std::vector<LeafRecord>& leaves, const std::function<TieRank(Point)>& rank);

}  // namespace quadloop
