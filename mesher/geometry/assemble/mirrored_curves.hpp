#pragma once

#include <vector>

#include "mesher/geometry/geometry.hpp"
#include "mesher/geometry/mirror_axis.hpp"

namespace quadloop {

/// Makes the curves of chains exact mirror images of each other, as the ends of their segments are already:
/// curves below the axis become the images of those above it, curves across the axis become symmetric.
/// Throws InputError for a curve that differs from its image by more than `tolerance`.
void fit_curves_to_mirror(std::vector<Chain>& chains, MirrorAxis axis, double tolerance);

}  // namespace quadloop
