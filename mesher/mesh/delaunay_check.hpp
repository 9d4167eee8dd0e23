#pragma once

#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Whether a mesh that is whole on this rank is a constrained Delaunay triangulation: triangles alone, and none whose circumcircle holds the opposite
/// node of a neighbour. Exact; nodes on one circle are no contradiction.
bool is_delaunay(const Mesh& whole);

}  // namespace quadloop
