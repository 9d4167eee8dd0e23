#pragma once

#include <functional>

#include "mesher/build/build_mesh.hpp"
#include "mesher/cut/cut_forest.hpp"
#include "mesher/delaunay/tie_order.hpp"

namespace quadloop {

/// Makes a mesh of triangles the constrained Delaunay triangulation of the same nodes, over the whole domain
/// (thesis 3.6.1), unique by the order of nodes `rank_of`; `leaves` say how many cells of the
/// mesh each local leaf has, before and after. A triangle belongs to the leaf that holds its centroid, so the
/// order of cells does not depend on the number of ranks. *Collective.*
///
/// In a leaf that is not cut, nor any around it, the triangles are constrained Delaunay already, with the
/// diagonals that assemble_mesh gives squares: no circumcircle reaches beyond the leaves that touch. Of the
/// others' triangles, edges that are not Delaunay are flipped wherever that leads; the result being unique,
/// no rank needs to know where others began.
void make_delaunay(const Communicator& comm, const Lattice& lattice,
                   const std::function<TieRank(Point)>& rank_of, const LeafGraph& graph, const CutForest& cut,
                   Mesh& mesh, std::vector<LeafRecord>& leaves);

}  // namespace quadloop
