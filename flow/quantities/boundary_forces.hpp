#pragma once

#include <string>
#include <vector>

#include "flow/quantities/free_stream.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// What the flow does to one boundary: force per depth over dynamic pressure and reference length, across and
/// along the free stream.
struct BoundaryForce {
  std::string boundary;
  double cl = 0, cd = 0;                    ///< by pressure, less the free stream's, and friction
  double cl_friction = 0, cd_friction = 0;  ///< the part of friction
};

/// The forces on the boundaries named, in their order, of any solver's nodal flow: pressure and, where the
/// flow has a variable wall_shear, friction, both linear along each edge. 0 where the free stream rests. The
/// same bits on any number of ranks. *Collective.*
std::vector<BoundaryForce> boundary_forces(const Communicator& comm, const Mesh& mesh, const Field& flow,
                                           const FreeStream& stream, const std::vector<std::string>& walls);

}  // namespace quadloop
