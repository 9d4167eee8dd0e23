#pragma once

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Throws Fault on all ranks, with the location, if a distributed mesh made by this program is not valid: a
/// corner is not positive, exactly and in rounded arithmetic; an edge is not used in opposite directions by
/// two cells, or by a cell and a boundary; two boundary edges have the same nodes; or the areas of the cells
/// do not sum to the area that the boundary encloses (relative 1e-10). If the boundary does not cross itself,
/// these rules exclude overlapping cells, as each point is covered as often as the boundary winds around it.
/// O(n), without a table of cell edges: with nodes at random positions in a ring of integers, the areas of
/// the cells sum to that enclosed by the boundary if each edge is used correctly, and otherwise with a
/// probability of about 2^-60 (Schwartz 1980 and Zippel 1979, of polynomials). validate() gives more detail
/// for a mesh that is whole on one rank. *Collective.*
void require_sound(const Communicator& comm, const Mesh& mesh);

/// Whether it does not throw. *Collective.*
bool is_sound(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop
