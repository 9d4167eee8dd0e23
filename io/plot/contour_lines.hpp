#pragma once

#include <array>
#include <vector>

#include "io/plot/value_raster.hpp"

namespace quadloop::io {

/// Returns `count` equidistant values between low and high, exclusively.
std::vector<double> contour_levels(double low, double high, int count);

/// Appends the contour lines of the piece for the levels, which must be ascending.
void append_contours(const LinearPiece& piece, const std::vector<double>& levels,
                     std::vector<std::array<Point, 2>>& lines);

}  // namespace quadloop::io
