#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/delaunay/tie_order.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/tree_record.hpp"

namespace quadloop {

/// Divides each quadrilateral that is no parallelogram (skew_of beyond parallel_skew) into two triangles, by
/// the diagonal that is Delaunay; of four nodes on one circle by the one through the node of the highest
/// rank. What schemes on median-dual cells make of a linear field is then exact at every inner node. The
/// triangles stand behind those of their leaf, whose counts in `leaves` follow. Not collective.
void split_skew_quads(Mesh& mesh, std::vector<LeafRecord>& leaves, const std::function<TieRank(Point)>& rank);

}  // namespace quadloop
