#pragma once

#include <string>
#include <vector>

#include "flow/quantities/free_stream.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// The names of the boundaries that are walls, by their conditions, in their order.
std::vector<std::string> walls_of(const Mesh& mesh);

/// The flow at the nodes of the walls named, whichever solver found it, as wall_table() and boundary_forces()
/// read it: a row for each owned node with x_velocity, y_velocity, pressure, density where the solution has
/// one, and wall_shear where the stream has a viscosity. Rows of other nodes tell nothing.
///
/// A solution at nodes gives its own values. From one in cells a node has what the cells at its wall edges
/// have, interpolated along the wall, and a velocity of 0 where there is friction: as a solver means it whose
/// pressure has no gradient at the wall. wall_shear is the solution's own, or that of SU2's
/// Skin_Friction_Coefficient_x and _y; else the viscosity times the slope, of first order, of the speed
/// along the wall from the wall to the first value above it (at the most upright neighbour, or the cell's
/// centroid). Of a turbulent flow that slope tells the friction where the first value lies in the viscous
/// sublayer. An "inviscid_wall" has no friction.
///
/// The same bits on any number of ranks. Throws InputError that begins with `where` for a solution without
/// velocity and pressure. *Collective.*
Field wall_flow(const Communicator& comm, const Mesh& mesh, const Field& solution, const FreeStream& stream,
                const std::vector<std::string>& walls, const std::string& where);

}  // namespace quadloop
