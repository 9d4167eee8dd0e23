#include "adapt/transfer/linear_values.hpp"

#include <algorithm>

#include "mesher/geometry/nearest_on_segment.hpp"

namespace quadloop::adapt {

namespace {

void copy(std::span<const double> from, std::span<double> to) {
  std::copy(from.begin(), from.end(), to.begin());
}

/// The corner nearest to p, the first of equal ones: weights relative to it are most accurate.
std::size_t nearest_corner(const std::array<Point, 3>& corners, Point p) {
  std::size_t nearest = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (dot(corners[k] - p, corners[k] - p) < dot(corners[nearest] - p, corners[nearest] - p)) nearest = k;
  }
  return nearest;
}

void interpolate_on_nearest_side(const std::array<Point, 3>& corners,
                                 const std::array<std::span<const double>, 3>& at_corners, Point p,
                                 std::span<double> values, Combine combine) {
  std::size_t side = 0;
  PlaceOnSegment best = place_on_segment(p, corners[0], corners[1]);
  for (std::size_t k = 1; k < 3; ++k) {
    const PlaceOnSegment other = place_on_segment(p, corners[k], corners[(k + 1) % 3]);
    if (!(other.squared_distance < best.squared_distance)) continue;
    best = other;
    side = k;
  }
  interpolate_on_segment(at_corners[side], at_corners[(side + 1) % 3], best.parameter, values, combine);
}

}  // namespace

void combine_values(std::span<const std::span<const double>> rows, std::span<const double> weights,
                    std::span<double> result) {
  for (std::size_t n = 0; n < result.size(); ++n) {
    double sum = weights[0] * rows[0][n], low = rows[0][n], high = rows[0][n];
    for (std::size_t k = 1; k < rows.size(); ++k) {
      sum += weights[k] * rows[k][n];
      low = std::min(low, rows[k][n]);
      high = std::max(high, rows[k][n]);
    }
    result[n] = std::clamp(sum, low, high);
  }
}

void interpolate_on_segment(std::span<const double> at_a, std::span<const double> at_b, double parameter,
                            std::span<double> values, Combine combine) {
  if (parameter <= 0) return copy(at_a, values);
  if (parameter >= 1) return copy(at_b, values);
  combine(std::array{at_a, at_b}, std::array{1 - parameter, parameter}, values);
}

void interpolate_in_triangle(const std::array<Point, 3>& corners,
                             const std::array<std::span<const double>, 3>& at_corners, Point p,
                             std::span<double> values, Combine combine) {
  const std::size_t i = nearest_corner(corners, p), j = (i + 1) % 3, k = (i + 2) % 3;
  if (p == corners[i]) return copy(at_corners[i], values);
  const Point first = corners[j] - corners[i], second = corners[k] - corners[i], off = p - corners[i];
  const double area = cross(first, second);
  if (!(area > 0)) return interpolate_on_nearest_side(corners, at_corners, p, values, combine);
  double s = std::clamp(cross(off, second) / area, 0.0, 1.0),
         t = std::clamp(cross(first, off) / area, 0.0, 1.0);
  if (s + t > 1) {
    const double sum = s + t;
    s /= sum;
    t /= sum;
  }
  combine(std::array{at_corners[i], at_corners[j], at_corners[k]}, std::array{std::max(0.0, 1 - s - t), s, t},
          values);
}

}  // namespace quadloop::adapt
