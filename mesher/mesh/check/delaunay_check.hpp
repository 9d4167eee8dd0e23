#pragma once

#include <cstdint>
#include <span>

#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Whether a mesh that is whole on this rank is a constrained Delaunay triangulation: triangles only, and no
/// circumcircle contains the opposite node of a neighbour; edges between triangles of two blocks are
/// constraints. Exact; cocircular nodes are allowed. `triangle_to_block` has an entry for each triangle;
/// empty: one block.
bool is_delaunay(const Mesh& whole, std::span<const std::int32_t> triangle_to_block = {});

}  // namespace quadloop
