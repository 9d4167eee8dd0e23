#pragma once

#include "adapt/morph/boundary_motion.hpp"
#include "adapt/morph/morph_report.hpp"

namespace quadloop::adapt {

/// Moves the nodes of a mesh to a changed geometry; the cells do not change. Boundary nodes move by
/// boundary_motion(), columns of layers on walls with their feet, all others follow the boundary and the
/// outer edges of layers (InverseDistance). Without smoothing, node positions are smooth functions of the new
/// geometry's points; so smoothing is applied only if the worst cell loses more than a fifth of its quality.
/// Then the cells outside layers that lose as much are smoothed, and those near them, except the nodes
/// between two blocks and those of inner lines. If the mesh cannot follow, or not with `least_quality` of the
/// worst cell, it is left with these cells and the report contains the possible fraction. Bitwise independent
/// of the number of ranks. Throws InputError as boundary_motion() does, and if the two sides of a periodic
/// pair do not move alike. *Collective.*
MorphReport morph_mesh(const Communicator& comm, Mesh& mesh, const OutlineChange& change,
                       double least_quality = 0);

}  // namespace quadloop::adapt
