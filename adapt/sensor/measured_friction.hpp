#pragma once

#include <span>
#include <string>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/measured_flow.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// Data that convert wall shear to wall units, in the solver's units except for lengths, which are in the
/// geometry's unit.
struct WallFlow {
  double viscosity = 0;         ///< dynamic viscosity at the wall, positive
  double density = 1;           ///< density at the wall if the solution has none, positive
  double dynamic_pressure = 0;  ///< of the free stream, for friction coefficients; 0: they are not used

  friend bool operator==(const WallFlow&, const WallFlow&) = default;
};

/// The friction of a solution at the walls with these names. With the nodal variable `wall_shear`, of either
/// sign: u_tau = sqrt(|shear| / density); or the shear from SU2's Skin_Friction_Coefficient_x and _y, times
/// the dynamic pressure. Else from `y_plus` (yplus, y+) of the first node off the wall, whose distance is the
/// height of the wall-adjacent cells; where the wall turns by more than 30 degrees, the value of the next
/// node is used. At the root of a wake this holds for each of these variables. If these are not nodal
/// variables, wall-adjacent cells are used: `y_plus` of their centres, else `wall_shear`, else the magnitude
/// of `wallShearStress_x` and `_y`; a node has the mean of its wall edges. Edges are sorted by the global
/// numbers of their nodes, with the same bits on every rank and on any number of ranks. Empty if the solution
/// has none of these variables. Throws InputError, with `where` as prefix, for a value that is not finite.
/// *Collective.*
MeasuredWall measured_friction(const Communicator& comm, const Mesh& mesh, const Field& solution,
                               std::span<const std::string> walls, const WallFlow& flow,
                               const std::string& where);

}  // namespace quadloop::adapt
