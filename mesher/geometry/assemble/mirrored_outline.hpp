#pragma once

#include <string>
#include <vector>

#include "mesher/base/id_vector.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/geometry/mirror_axis.hpp"

namespace quadloop {

/// How far a point may lie from where its image says, of the longer side of the chains' box: that is
/// rounding.
inline constexpr double mirror_rounding = 1e-12;

/// Makes chains that are their own mirror image but for rounding so to the last bit: points below the axis
/// become the images of those above it. A warning counts them. Throws InputError, naming the first point
/// without an image and the chain that it is of.
void fit_to_mirror(std::vector<Chain>& chains, MirrorAxis axis, Warnings& warnings);

/// Throws InputError, naming the place, unless the outline is its own mirror image, to the last bit: each
/// segment has its image, of the same boundary or of one that asks for the same spacing, corners and layers
/// and is the image of this one everywhere. The image of each boundary.
IdVector<BoundaryId, BoundaryId> require_mirror_images(const Geometry& geometry, MirrorAxis axis);

/// Of an outline that is its own mirror image the half above the axis (on its right: of the y-axis), as open
/// chains: the outline's parts there, and between them along the axis those of a boundary `name`. Where the
/// outline crosses the axis within a segment, as a blunt edge may, there is a point then.
std::vector<Chain> half_outline(const Geometry& geometry, MirrorAxis axis, const std::string& name);

}  // namespace quadloop
