#include "flow/euler/scheme/skewness.hpp"

#include <algorithm>

namespace quadloop::flow::euler {

namespace {

constexpr double farthest = 0.9;         ///< in units of Nearness::reach
constexpr double least_size = 1.0 / 20;  ///< size of a face relative to its edge length

/// 1 up to the limit, decreasing to 0 at 1.5 times the limit.
double fading(double ratio) { return std::clamp(3 - 2 * ratio, 0.0, 1.0); }

}  // namespace

double share_left_over(double length, double size) {
  return size > 0 ? fading(least_size * length / size) : 0;
}

Skewness bearable(const SkewFace& face, const Nearness& low, const Nearness& high) {
  if (face.size == 0) return face.sum;
  const auto reach = [&](Point way) { return std::max(low.reach(way), high.reach(way)); };
  const Point middle{dot(face.of_middle.with_x, face.normal) / face.size,
                     dot(face.of_middle.with_y, face.normal) / face.size};
  const double of_middle = fading(reach(middle) / farthest);
  const double left_over =
      share_left_over(length(face.edge), face.size) * fading(reach((1.0 / 12) * face.edge) / farthest);
  if (of_middle == 1 && left_over == 1) return face.sum;
  return of_middle * face.of_middle + left_over * face.left_over;
}

}  // namespace quadloop::flow::euler
