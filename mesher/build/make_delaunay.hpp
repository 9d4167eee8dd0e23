#pragma once

#include <functional>

#include "mesher/build/build_mesh.hpp"
#include "mesher/cut/cut_forest.hpp"
#include "mesher/delaunay/tie_order.hpp"

namespace quadloop {

/// Converts a triangular mesh to the constrained Delaunay triangulation of the same nodes over the whole
/// domain (thesis 3.6.1), made unique by the node order `rank_of`. `leaves` contains the number of cells of
/// each local leaf, before and after. A triangle belongs to the leaf that contains its centroid, so the order
/// of cells does not depend on the number of ranks. *Collective.*
///
/// In a leaf that is uncut, as are all its neighbours, the triangles are constrained Delaunay already, with
/// the diagonals that assemble_mesh uses for squares: no circumcircle extends beyond the adjacent leaves.
/// Among the other triangles, non-Delaunay edges are flipped until there are none; as the result is unique,
/// the ranks need not agree on the order of flips.
void make_delaunay(const Communicator& comm, const TreeGrid& grid,
                   const std::function<TieRank(Point)>& rank_of, const LeafGraph& graph, const CutForest& cut,
                   Mesh& mesh, std::vector<LeafRecord>& leaves);

}  // namespace quadloop
