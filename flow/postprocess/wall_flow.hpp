#pragma once

#include <string>
#include <vector>

#include "flow/postprocess/free_stream.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::flow {

/// Returns the names of the boundaries with a wall condition, in the order of the mesh.
std::vector<std::string> walls_of(const Mesh& mesh);

/// Returns the flow at the nodes of the named walls, for any solver, as input of wall_table() and
/// boundary_forces(): a row for each owned node with x_velocity, y_velocity, pressure, density if the
/// solution has it, and wall_shear if the free stream has a viscosity. Rows of other nodes are undefined.
///
/// A nodal solution is used directly. For a cell-centred solution, the value at a wall node is interpolated
/// along the wall from the cells adjacent to its wall edges (zero normal pressure gradient); at no-slip walls
/// the velocity is 0. wall_shear is taken from the solution, or from SU2's Skin_Friction_Coefficient_x and
/// _y, if present. Otherwise it is the viscosity times the first-order wall-normal gradient of the tangential
/// velocity, between the wall and the neighbour node closest to the normal, or the cell centroid. In
/// turbulent flow this is accurate only if that point lies in the viscous sublayer. An "inviscid_wall" has no
/// friction.
///
/// Bitwise independent of the number of ranks. Throws InputError that begins with `where` for a solution
/// without velocity and pressure. *Collective.*
Field wall_flow(const Communicator& comm, const Mesh& mesh, const Field& solution, const FreeStream& stream,
                const std::vector<std::string>& walls, const std::string& where);

}  // namespace quadloop::flow
