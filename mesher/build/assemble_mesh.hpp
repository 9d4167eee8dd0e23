#pragma once

#include "mesher/build/build_mesh.hpp"
#include "mesher/cut/cut_forest.hpp"

namespace quadloop {

/// The distributed mesh and the tree record from the cut forest. For `triangles_alone` each quadrilateral is
/// divided by one of its leaf's diagonals: through the corner that the leaf shares with its parent.
/// *Collective.*
void assemble_mesh(const Communicator& comm, const Geometry& geometry, const SizeTree& sizes,
                   const LeafGraph& graph, const CutForest& cut, bool triangles_alone, MeshResult& result);

}  // namespace quadloop
