#pragma once

#include <string>
#include <vector>

#include "adapt/remesh/demands/adapt_options.hpp"
#include "adapt/remesh/demands/solved_mesh.hpp"
#include "generate/generate.hpp"

namespace quadloop::adapt {

/// Returns the wall friction for the first heights of the next mesh, for walls that specify a y+: that of the
/// solution, or, where it has none, that which the tree was made with. *Collective.*
MeasuredWall wall_to_follow(const Communicator& comm, const MeshInput& input, const AdaptOptions& options,
                            const SolvedMesh& solved);

/// Returns the thickness of the boundary layer for walls whose layers follow it (measured_thickness()): that
/// of the solution; where it is unknown, that which the tree was made with. Adds a warning if the solution
/// has no velocity at nodes. *Collective.*
std::vector<MeasuredThickness> thickness_to_follow(const Communicator& comm, const MeshInput& input,
                                                   const SolvedMesh& solved,
                                                   std::vector<std::string>& warnings);

/// Whether any first height of the input's walls differs by more than 5 %, or the thickness of layers that
/// follow the flow by more than 10 %.
bool other_heights(const MeshInput& input, const MeasuredFlow& before, const MeasuredFlow& now);

}  // namespace quadloop::adapt
