#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/geometry/point.hpp"
#include "smoother/objective/condition_number.hpp"

namespace quadloop::smoother {

/// Which angles of a triangle p, q, r are angles of the cell: all of a triangle cell, one per corner of a
/// quadrilateral.
enum class CellAngle : std::uint8_t { all, at_p, at_q, at_r };

/// A corner of a cell whose shape depends on node p: the counter-clockwise triangle p, q, r, with the target
/// seen from p.
struct StarCorner {
  Point q, r;
  CornerTarget target;
  CellAngle angle = CellAngle::all;
};

/// Sums or maxima over the corners of a star, for several positions of its node.
template <int places>
struct StarSums {
  std::array<double, places> costs{}, squares{}, defects{}, cotangents{};
  std::array<double, places> soundness{};  ///< positive if no corner is inverted
};

/// The same for one position, with the sum of the cubed defects, its derivatives, and the sum of squared edge
/// lengths.
struct StarDerivatives {
  double squares = 0, cubes = 0, defects = 0, cotangents = 0, soundness = 1;
  Point gradient;
  double xx = 0, xy = 0, yy = 0;
  double edges = 0;
};

/// The loops that take most of the smoothing time, for vectors of 2, 4 or 8 doubles. Each operation is
/// rounded separately and sums run in corner order, so the results have the same bits for any width.
struct StarKernels {
  static constexpr int batch = 8;
  StarDerivatives (*derivatives)(std::span<const StarCorner> corners, Point p);
  StarSums<batch> (*sums)(std::span<const StarCorner> corners, const double* x, const double* y);
};

/// The sums at one position, by the default instruction set.
StarSums<1> star_sums(std::span<const StarCorner> corners, Point p);

/// The kernels that this processor can run, the widest last.
std::vector<StarKernels> star_kernels();

}  // namespace quadloop::smoother
