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

/// Whether any first height of the input's walls differs by more than 5 %.
bool other_heights(const MeshInput& input, const MeasuredWall& before, const MeasuredWall& now);

}  // namespace quadloop::adapt
