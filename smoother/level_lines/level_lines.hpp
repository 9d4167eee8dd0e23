#pragma once

#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop {

/// Where squares of two sizes meet, the larger ones are divided at their hanging nodes, which leaves corners
/// of 26.6 degrees. Moves the nodes of such a line together, by a quarter of the smaller edge towards the
/// larger squares: that makes 29.7 degrees of them, and the smaller squares become rectangles, not skew
/// quadrilaterals (but for one at each end of a straight line), as they would where each node went its own
/// way.
///
/// A node is moved if its cells are two equal squares on one side of the line and the triangles of such a
/// division on the other, and it is neither pinned (a flag for each owned node, or none at all) nor of a cell
/// that would come to cost more than it does and than `limit`, Eq. 3.2. The copies move too. Returns whether
/// any node was moved on any rank. *Collective.*
bool move_square_lines(const Communicator& comm, HaloMesh& mesh, const NodeFlags& pinned, double limit);

/// The same in a mesh of triangles, where the squares are halved too, for owned nodes flagged `near`: each
/// node of the triangles at a line goes where its place in the pattern of such lines asks for. Returns
/// flags of those that moved and have edges round them that may be Delaunay no more; no flags at all where
/// nothing was moved on any rank. *Collective.*
NodeFlags move_triangle_lines(const Communicator& comm, HaloMesh& mesh, const NodeFlags& near,
                              const NodeFlags& pinned, double limit);

}  // namespace quadloop
