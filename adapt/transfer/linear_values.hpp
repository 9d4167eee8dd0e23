#pragma once

#include <array>
#include <span>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// Values along a segment by its parameter: those of an end bit for bit there, none outside the range of the
/// two.
void interpolate_on_segment(std::span<const double> at_a, std::span<const double> at_b, double parameter,
                            std::span<double> values);

/// Values at a point of a counter-clockwise triangle, interpolated linearly: those of a corner bit for bit
/// there, none outside the range of the three, also where the weights come out badly (a triangle that
/// rounding makes flat, a point outside by rounding).
void interpolate_in_triangle(const std::array<Point, 3>& corners,
                             const std::array<std::span<const double>, 3>& at_corners, Point p,
                             std::span<double> values);

}  // namespace quadloop
