#pragma once

#include <vector>

#include "adapt/metric/loose_triangles.hpp"
#include "mesher/build/build_mesh.hpp"
#include "mesher/grid/tree_grid.hpp"

namespace quadloop::adapt {

/// Assigns each triangle of the adapted `mesh` to the leaf of the tree that contains its centroid, on the
/// rank that has the leaf. Replaces the result's mesh, its leaves' counts and its boundary edges' leaves by
/// those of `mesh`. Triangles are ordered by leaf along the curve, within a leaf by their node numbers in
/// `mesh`. *Collective.*
void share_among_leaves(const Communicator& comm, const TreeGrid& grid, const Mesh& mesh, MeshResult& result);

}  // namespace quadloop::adapt
