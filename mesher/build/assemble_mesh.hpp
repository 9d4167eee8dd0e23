#pragma once

#include "mesher/build/build_mesh.hpp"
#include "mesher/cut/cut_forest.hpp"

namespace quadloop {

/// The distributed mesh and the tree record from the cut forest. *Collective.*
void assemble_mesh(const Communicator& comm, const Geometry& geometry, const SizeTree& sizes,
                   const LeafGraph& graph, const CutForest& cut, MeshResult& result);

}  // namespace quadloop
