#pragma once

#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop::smoother {

/// Where squares of two sizes meet, the larger ones are divided at their hanging nodes, which gives angles of
/// 26.6 degrees. Moves the nodes of such a line together by a quarter of the smaller edge towards the larger
/// squares. The smallest angle becomes 29.7 degrees, and the smaller squares become rectangles; independent
/// moves would make them skew quadrilaterals (as remains at each end of a straight line).
///
/// A node is moved if its cells are two equal squares on one side of the line and the triangles of such a
/// division on the other. A node stays if it is pinned (`pinned`: a flag for each owned node, or empty), or
/// if one of its cells would cost more than `limit` (Eq. 3.2) and more than before. Ghost copies move too.
/// Returns whether any node was moved on any rank. *Collective.*
bool move_square_lines(const Communicator& comm, HaloMesh& mesh, const NodeFlags& pinned, double limit);

/// The same for a mesh of triangles, in which the squares are halved too. Moves owned nodes flagged `near`;
/// each node near a line has the move of its kind in the pattern of such lines. Returns flags of the moved
/// nodes whose edges may have become non-Delaunay; empty if nothing was moved on any rank. *Collective.*
NodeFlags move_triangle_lines(const Communicator& comm, HaloMesh& mesh, const NodeFlags& near,
                              const NodeFlags& pinned, double limit);

}  // namespace quadloop::smoother
