#pragma once

#include <string>
#include <vector>

#include "flow/quantities/free_stream.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// What follows the prefix of a solution's file in the name of its wall table.
inline constexpr const char* wall_table_suffix = ".walls.csv";

/// The flow along the boundaries named, in their order, as the text of a table on the root, elsewhere empty:
/// columns boundary, s, x, y, Cp, Mach, and where the free stream has a viscosity Cf, y+; a row a node in the
/// order in which the boundary is walked, the domain to the left. `s` is the length walked: an open chain
/// from its end, a loop from its node farthest along x, the lowest of those, an airfoil's trailing edge. The
/// first node of a loop stands at its end again. With each chain `s` begins at 0, and chains come in the
/// order of the mesh's edges. Cf is the variable wall_shear over the dynamic pressure, positive the way of
/// the free stream; y+ is that of the nearest nodes above the wall. The same text on any number of ranks.
/// *Collective.*
std::string wall_table(const Communicator& comm, const Mesh& mesh, const Field& flow,
                       const FreeStream& stream, const std::vector<std::string>& walls);

}  // namespace quadloop
