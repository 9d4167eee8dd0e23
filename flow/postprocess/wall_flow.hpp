#pragma once

#include <string>
#include <vector>

#include "flow/postprocess/free_stream.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Returns the names of the boundaries that are walls by their conditions, in their order.
std::vector<std::string> walls_of(const Mesh& mesh);

/// Returns the flow at the nodes of the named walls, for any solver, as input of wall_table() and
/// boundary_forces(): a row for each owned node with x_velocity, y_velocity, pressure, density if the
/// solution has it, and wall_shear if the stream has a viscosity. Rows of other nodes are undefined.
///
/// A nodal solution is used directly. For a cell-centred one, the values of the cells at a node's wall edges
/// are interpolated along the wall, assuming zero pressure gradient at the wall, with velocity 0 if there is
/// friction. wall_shear is the solution's own, or that of SU2's Skin_Friction_Coefficient_x and _y; else the
/// viscosity times the first-order gradient of the tangential velocity from the wall to the first value above
/// it (at the neighbour closest to the normal, or the cell's centroid). In turbulent flow this gives the
/// friction if the first value lies in the viscous sublayer. An "inviscid_wall" has no friction.
///
/// Bitwise independent of the number of ranks. Throws InputError that begins with `where` for a solution
/// without velocity and pressure. *Collective.*
Field wall_flow(const Communicator& comm, const Mesh& mesh, const Field& solution, const FreeStream& stream,
                const std::vector<std::string>& walls, const std::string& where);

}  // namespace quadloop
