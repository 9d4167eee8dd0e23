#pragma once

#include <vector>

#include "adapt/metric/loose_triangles.hpp"
#include "mesher/build/build_mesh.hpp"
#include "mesher/lattice/lattice.hpp"

namespace quadloop {

/// Gives each triangle of `mesh`, which has been adapted, to the leaf of the tree that holds its centroid, on
/// the rank that has the leaf: the result's mesh, its leaves' counts and its boundary edges' leaves become
/// those of `mesh`. Leaf after leaf along the curve; within one by the nodes' numbers in `mesh`.
/// *Collective.*
void share_among_leaves(const Communicator& comm, const Lattice& lattice, const Mesh& mesh,
                        MeshResult& result);

}  // namespace quadloop
