#pragma once

#include <array>
#include <vector>

#include "io/plot/value_raster.hpp"

namespace quadloop {

/// `count` values evenly between low and high, which are not among them.
std::vector<double> contour_levels(double low, double high, int count);

/// Where the value over the piece is one of the levels, which ascend: a line for each that crosses it.
void append_contours(const LinearPiece& piece, const std::vector<double>& levels,
                     std::vector<std::array<Point, 2>>& lines);

}  // namespace quadloop
