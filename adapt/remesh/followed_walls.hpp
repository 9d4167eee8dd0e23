#pragma once

#include <string>
#include <vector>

#include "adapt/remesh/demands/adapt_options.hpp"
#include "adapt/remesh/demands/solved_mesh.hpp"
#include "generate/generate.hpp"

namespace quadloop {

/// The friction that first heights are to follow after a solution: what it tells of the walls that want a
/// y+; where it tells nothing, what the tree was made with. *Collective.*
MeasuredWall wall_to_follow(const Communicator& comm, const MeshInput& input, const AdaptOptions& options,
                            const SolvedMesh& solved);

/// Whether any first height that the input's walls ask for differs by more than a twentieth.
bool other_heights(const MeshInput& input, const MeasuredWall& before, const MeasuredWall& now);

}  // namespace quadloop
