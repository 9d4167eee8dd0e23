#pragma once

#include <array>
#include <span>

#include "mesher/geometry/point.hpp"

namespace quadloop::adapt {

/// Combines the rows of one to three nodes with their weights into a row.
using Combine = void (*)(std::span<const std::span<const double>> rows, std::span<const double> weights,
                         std::span<double> result);

/// The weighted sum, within the range of the rows.
void combine_values(std::span<const std::span<const double>> rows, std::span<const double> weights,
                    std::span<double> result);

/// Values along a segment by its parameter: at an end exactly the end's values, otherwise within the range of
/// both.
void interpolate_on_segment(std::span<const double> at_a, std::span<const double> at_b, double parameter,
                            std::span<double> values, Combine combine = combine_values);

/// Values at a point of a counter-clockwise triangle by linear interpolation: at a corner exactly the
/// corner's values, otherwise within the range of the three, even if the weights are inaccurate (a triangle
/// made flat by rounding, a point outside by rounding).
void interpolate_in_triangle(const std::array<Point, 3>& corners,
                             const std::array<std::span<const double>, 3>& at_corners, Point p,
                             std::span<double> values, Combine combine = combine_values);

}  // namespace quadloop::adapt
