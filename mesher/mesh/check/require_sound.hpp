#pragma once

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Throws Fault on all ranks, with the place, where a distributed mesh that this program made is not valid:
/// a corner that is not positive, exactly and in rounded arithmetic; an edge that two cells, or a cell and a
/// boundary, do not use in opposite directions; cells that do not add up to the area that the boundary
/// encloses (relative 1e-10). Where the boundary does not cross itself no two cells overlap then, as each
/// point is covered as often as the boundary goes round it. O(n), without a table of edges: with nodes placed
/// at random in a ring of integers the cells' areas add up to what the boundary encloses if each edge is used
/// as it should be, and else once in some 2^60 times (Schwartz 1980 and Zippel 1979, of polynomials).
/// validate() tells more of a mesh that is whole on one rank. *Collective.*
void require_sound(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop
