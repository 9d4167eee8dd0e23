#include "io/plot/contour_lines.hpp"

#include <algorithm>
#include <cmath>

namespace quadloop::io {

std::vector<double> contour_levels(double low, double high, int count) {
  std::vector<double> levels;
  for (int k = 1; k <= count; ++k) levels.push_back(low + (high - low) * k / (count + 1));
  return levels;
}

void append_contours(const LinearPiece& piece, const std::vector<double>& levels,
                     std::vector<std::array<Point, 2>>& lines) {
  const auto& values = piece.values;
  if (!std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); })) return;
  const auto [low, high] = std::minmax({values[0], values[1], values[2]});
  for (auto level = std::upper_bound(levels.begin(), levels.end(), low);
       level != levels.end() && *level <= high; ++level) {
    std::array<Point, 2> line{};
    std::size_t ends = 0;
    for (std::size_t k = 0; k < 3 && ends < 2; ++k) {
      const double from = values[k] - *level, to = values[(k + 1) % 3] - *level;
      if ((from >= 0) == (to >= 0)) continue;
      const Point a = piece.corners[k], b = piece.corners[(k + 1) % 3];
      line[ends++] = a + from / (from - to) * (b - a);
    }
    if (ends == 2) lines.push_back(line);
  }
}

}  // namespace quadloop::io
