#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesher/geometry/point.hpp"
#include "smoother/objective/condition_number.hpp"

namespace quadloop {

/// Which angles of a triangle p, q, r are angles of the cell: all of a triangle's, one for each corner of a
/// quad.
enum class CellAngle : std::uint8_t { all, at_p, at_q, at_r };

/// A corner of a cell whose shape hangs on node p: the triangle p, q, r, counter-clockwise, with the target
/// seen from p.
struct StarCorner {
  Point q, r;
  CornerTarget target;
  CellAngle angle = CellAngle::all;
};

/// What the corners of a star add up to, or the most of any, with its node at several places, place by place.
template <int places>
struct StarSums {
  std::array<double, places> costs{}, squares{}, defects{}, cotangents{};
  std::array<double, places> soundness{};  ///< above 0 where no corner is inverted
};

/// The same at one place, with the sum of the cubes of the defects, its derivatives, and the squared lengths
/// of edges.
struct StarDerivatives {
  double squares = 0, cubes = 0, defects = 0, cotangents = 0, soundness = 1;
  Point gradient;
  double xx = 0, xy = 0, yy = 0;
  double edges = 0;
};

/// The loops that smoothing spends most of its time in, for vectors of 2, 4 or 8 doubles. Each operation is
/// rounded on its own and sums run in the order of the corners, so results have the same bits by any.
struct StarKernels {
  static constexpr int batch = 8;
  StarDerivatives (*derivatives)(std::span<const StarCorner> corners, Point p);
  StarSums<batch> (*sums)(std::span<const StarCorner> corners, const double* x, const double* y);
};

/// The sums at one place, by whatever is at hand.
StarSums<1> star_sums(std::span<const StarCorner> corners, Point p);

/// Those that this processor can run, the widest last.
std::vector<StarKernels> star_kernels();

}  // namespace quadloop
