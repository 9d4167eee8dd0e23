#pragma once

#include <cstdint>
#include <span>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Whether a mesh is a constrained Delaunay triangulation: triangles only, and no circumcircle contains the
/// opposite node of a neighbour; edges between triangles of two blocks, and inner lines, are constraints.
/// Exact; cocircular nodes are allowed. `triangle_to_block` has an entry for each of this rank's triangles;
/// empty: one block. *Collective.*
bool is_delaunay(const Communicator& comm, const Mesh& mesh,
                 std::span<const std::int32_t> triangle_to_block = {});

/// The same for a mesh that is whole on this rank.
bool is_delaunay(const Mesh& whole, std::span<const std::int32_t> triangle_to_block = {});

}  // namespace quadloop
