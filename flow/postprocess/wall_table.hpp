#pragma once

#include <string>
#include <vector>

#include "flow/postprocess/free_stream.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::flow {

/// Suffix of the wall table; it follows the prefix of the solution's file.
inline constexpr const char* wall_table_suffix = ".walls.csv";

/// Returns the flow along the named boundaries, in their order, as the text of a table on the root (empty
/// elsewhere): columns boundary, s, x, y, Cp, Mach, and Cf, y+ if the free stream has a viscosity; one row
/// per node in the direction of the boundary, with the domain to the left. `s` is the arc length: an open
/// chain begins at its end, a loop at its node of largest x, the lowest of those (the trailing edge of an
/// airfoil). The first node of a loop is repeated at its end. `s` restarts at 0 for each chain; chains are in
/// the order of the mesh's edges. Cf is wall_shear over the dynamic pressure, positive downstream; y+ is that
/// of the first nodes above the wall. Independent of the number of ranks. *Collective.*
std::string wall_table(const Communicator& comm, const Mesh& mesh, const Field& flow,
                       const FreeStream& stream, const std::vector<std::string>& walls);

}  // namespace quadloop::flow
