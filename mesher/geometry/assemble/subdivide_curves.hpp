#pragma once

#include <string>
#include <vector>

#include "mesher/geometry/geometry.hpp"

namespace quadloop {

struct AssembleOptions;

/// Turning angle of a curve that requests no spacing, per cell: it requests the length of such a piece.
constexpr double degrees_of_cell = 15;

/// Subdivides the curves of chains until decisions that are made on their chords hold for the curves too: no
/// curve turns by more than 15 degrees nor is farther from its chord than a fraction of the cells there, and
/// the convex hulls of the control points of two curves are disjoint, except for a common end. Then curves
/// and chords are isotopic, as the curves can be deformed into their chords within these hulls. Throws
/// InputError with a place if two curves touch. Equal curves stay equal. Of curves that interpolate points,
/// those that touch become straight, with a warning.
void subdivide_curves(std::vector<Chain>& chains, const AssembleOptions& options,
                      std::vector<std::string>& warnings);

}  // namespace quadloop
