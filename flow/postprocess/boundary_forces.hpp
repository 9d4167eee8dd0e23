#pragma once

#include <string>
#include <vector>

#include "flow/postprocess/free_stream.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::flow {

/// Force of the flow on one boundary: lift and drag per unit depth, divided by dynamic pressure and reference
/// length.
struct BoundaryForce {
  std::string boundary;
  double cl = 0, cd = 0;                    ///< of pressure (minus free-stream pressure) and friction
  double cl_friction = 0, cd_friction = 0;  ///< friction only
};

/// Returns the forces on the named boundaries, in their order, for the nodal solution of any solver. The
/// pressure and, if the solution has a variable wall_shear, the friction are integrated; both are linear
/// along each edge. The forces are 0 if the free stream is at rest. Bitwise independent of the number of
/// ranks. *Collective.*
std::vector<BoundaryForce> boundary_forces(const Communicator& comm, const Mesh& mesh, const Field& flow,
                                           const FreeStream& stream, const std::vector<std::string>& walls);

}  // namespace quadloop::flow
