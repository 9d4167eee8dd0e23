#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/layers/layer_nodes.hpp"
#include "smoother/smooth_options.hpp"

namespace quadloop {

/// A cell whose longest edge is so many times as long as its shortest is taken for one of layers behind an
/// edge, in a mesh with layers on walls that names no strips, as files of earlier versions do not.
inline constexpr double stretched_like_layers = 5;

/// Makes the smoother leave layers as they are: their nodes, those of the front too, are pinned, and flips
/// keep their edges; so with cells that are stretched like them, where strips are not named. Nothing in a
/// mesh without layers. `options` are for this mesh, all but that in place. *Collective.*
void keep_layers(const Communicator& comm, const Mesh& mesh, SmoothOptions& options);

/// A block for each of this rank's triangles, such that flips, which keep edges between two blocks, keep
/// those of layers: a negative one of its own for a triangle in layers or beside a strip, else what `given`
/// says, or 0 where it is empty. *Collective.*
std::vector<std::int32_t> blocks_for_flips(const Communicator& comm, const Mesh& mesh,
                                           const LayerPlaces& places, const std::vector<std::int32_t>& given);

}  // namespace quadloop
