#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"
#include "smoother/smooth_options.hpp"

namespace quadloop::smoother {

/// A cell whose longest edge is more than this many times its shortest edge is taken for a layer cell, in a
/// mesh with layers on walls but without named strips (a file of an earlier version).
inline constexpr double stretched_like_layers = 5;

/// Makes the smoother keep the layers: pins their nodes, those on the outer edge included, and excludes their
/// edges from flips. Where strips are not named, cells as stretched as layer cells are kept too. Does nothing
/// for a mesh without layers. `options` must otherwise be complete for this mesh. *Collective.*
void keep_layers(const Communicator& comm, const Mesh& mesh, SmoothOptions& options);

/// Returns a block for each of this rank's triangles, so that flips keep the edges of layers (edges between
/// two blocks are not flipped). A triangle in layers or beside a strip has a negative block of its own; any
/// other has its block in `given`, or 0 if `given` is empty. *Collective.*
std::vector<std::int32_t> blocks_for_flips(const Communicator& comm, const Mesh& mesh,
                                           const LayerPlaces& places, const std::vector<std::int32_t>& given);

}  // namespace quadloop::smoother
