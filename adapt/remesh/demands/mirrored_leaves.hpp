#pragma once

#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/measured_wall.hpp"
#include "mesher/geometry/mirror_axis.hpp"
#include "mesher/mesh/tree_record.hpp"
#include "mesher/sizes/demanded_splits.hpp"

namespace quadloop {

/// The mirror image in an axis that halves the trees' root.
Quadrant image_of(MirrorAxis axis, const TreeAttributes& tree, const Quadrant& quadrant);

/// Of two values those that their leaves, which are each other's images, both get: the larger one, or the
/// smaller.
enum class OfImages { larger, smaller };

/// Gives leaves that are each other's images the same value; `values` has one for each of this rank's. A
/// flow on a mesh that is its own mirror image is its own image but for rounding, so marks made from it would
/// not be. Leaves without an image keep theirs. *Collective.*
void agree_with_images(const Communicator& comm, MirrorAxis axis, const TreeRecord& tree, OfImages of_images,
                       std::vector<double>& values);

/// The demands and their images.
std::vector<SplitDemand> with_images(MirrorAxis axis, const TreeAttributes& tree,
                                     std::vector<SplitDemand> demands);

/// The same for the friction along walls: the larger one counts.
void agree_with_images(MirrorAxis axis, MeasuredWall& wall);

}  // namespace quadloop
