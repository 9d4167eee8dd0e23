#pragma once

#include <span>
#include <string>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/measured_wall.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// What turns wall shear into wall units, in the solver's units but for lengths, which are the geometry's.
struct WallFlow {
  double viscosity = 0;  ///< dynamic, at the wall; above 0
  double density = 1;    ///< at the wall, where the solution has none; above 0

  friend bool operator==(const WallFlow&, const WallFlow&) = default;
};

/// The friction that a solution has at the walls of these names: from its variable `wall_shear`, of either
/// sign, with u_tau = sqrt(|shear| / density); else from `y_plus` (yplus, y+), that of the first node off the
/// wall, which is as high as the wall's cells are. A solution without these at its nodes tells them by the
/// cells at the walls: `y_plus` of their middles, else `wall_shear`, else the length of `wallShearStress_x`
/// and `_y`; at a node counts the mean of the edges that meet there. Edges in the order of the global numbers
/// of their nodes, the same bits on every rank and on any number of ranks. Empty where the solution has
/// neither. Throws InputError that begins with `where` for a value that is not finite. *Collective.*
MeasuredWall measured_friction(const Communicator& comm, const Mesh& mesh, const Field& solution,
                               std::span<const std::string> walls, const WallFlow& flow,
                               const std::string& where);

}  // namespace quadloop
