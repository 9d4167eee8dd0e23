#pragma once

#include "mesher/build/build_mesh.hpp"
#include "mesher/cut/cut_forest.hpp"

namespace quadloop {

/// Assembles the distributed mesh and the tree record from the cut forest. With `triangles_alone` each
/// quadrilateral is split by the diagonal through the corner that its leaf shares with its parent.
/// *Collective.*
void assemble_mesh(const Communicator& comm, const Geometry& geometry, const SizeTree& sizes,
                   const LeafGraph& graph, const CutForest& cut, bool triangles_alone, MeshResult& result);

}  // namespace quadloop
