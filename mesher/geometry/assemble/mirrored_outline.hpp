#pragma once

#include <string>
#include <vector>

#include "mesher/base/id_vector.hpp"
#include "mesher/geometry/assemble/assemble.hpp"
#include "mesher/geometry/mirror_axis.hpp"

namespace quadloop {

/// Largest distance of a point from its image that counts as rounding, relative to the longer side of the
/// chains' bounding box.
inline constexpr double mirror_rounding = 1e-12;

/// Makes chains that are mirror-symmetric up to rounding exactly symmetric: points below the axis are
/// replaced by the images of those above it. A warning counts them. Throws InputError with the first point
/// without an image and its chain.
void fit_to_mirror(std::vector<Chain>& chains, MirrorAxis axis, Warnings& warnings);

/// Checks that the geometry is exactly mirror-symmetric. Each segment must have an image, on the same
/// boundary or on a boundary with the same spacing, corners and layers; images of a boundary's segments must
/// all be on one boundary. Returns the image of each boundary. Throws InputError with the place otherwise.
IdVector<BoundaryId, BoundaryId> require_mirror_images(const Geometry& geometry, MirrorAxis axis);

/// The half of a mirror-symmetric geometry above the axis (right of the y-axis) as open chains: its parts
/// there, joined along the axis by parts of a boundary `name`. Where a segment crosses the axis, as at a
/// blunt edge, a point is inserted.
std::vector<Chain> half_outline(const Geometry& geometry, MirrorAxis axis, const std::string& name);

}  // namespace quadloop
