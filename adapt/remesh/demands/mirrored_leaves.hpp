#pragma once

#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/measured_flow.hpp"
#include "mesher/geometry/mirror_axis.hpp"
#include "mesher/mesh/tree_record.hpp"
#include "mesher/sizes/demanded_splits.hpp"

namespace quadloop::adapt {

/// Returns the mirror image in an axis that halves the root of the trees.
Quadrant image_of(MirrorAxis axis, const TreeAttributes& tree, const Quadrant& quadrant);

/// Which of the two values of mirror images both receive.
enum class OfImages { larger, smaller };

/// Gives mirror images the same value; `values` has one entry for each quadtree cell of this rank. A solution
/// on a mirror-symmetric mesh is symmetric except for rounding, so flags computed from it might not be. Cells
/// without an image keep their value. *Collective.*
void agree_with_images(const Communicator& comm, MirrorAxis axis, const TreeRecord& tree, OfImages of_images,
                       std::vector<double>& values);

/// Returns the demands and their mirror images.
std::vector<SplitDemand> with_images(MirrorAxis axis, const TreeAttributes& tree,
                                     std::vector<SplitDemand> demands);

/// Makes the wall friction symmetric: the larger value of two images counts.
void agree_with_images(MirrorAxis axis, MeasuredWall& wall);
void agree_with_images(MirrorAxis axis, std::vector<MeasuredThickness>& thickness);

/// Makes paths symmetric: the later of two that begin at mirror images becomes the image of the first, and
/// one that begins on the axis is moved to it.
void agree_with_images(MirrorAxis axis, std::vector<std::vector<Point>>& paths);

}  // namespace quadloop::adapt
