#include "mesher/layers/zipper.hpp"

#include <algorithm>
#include <limits>

namespace quadloop {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Infinite unless a, b, c turn left, or right; of mirror images the same to the last bit.
double cost_of(Point a, Point b, Point c, bool left) {
  const double area = left ? cross(b - a, c - a) : cross(c - a, b - a);
  if (!(area > 0)) return infinite;
  return (dot(b - a, b - a) + dot(c - b, c - b) + dot(a - c, a - c)) / area;
}

class Zipper {
 public:
  Zipper(std::span<const Point> first, std::span<const Point> second, bool left)
      : first_{first},
        second_{second},
        left_{left},
        closed_(first[0] == second[0]),
        cost_(first.size() * second.size(), infinite) {
    at(closed_ ? 1 : 0, 0) = 0;
    for (std::size_t i = 0; i < first_.size(); ++i) {
      for (std::size_t j = 0; j < second_.size(); ++j) {
        if (!begins(i, j)) at(i, j) = std::min(by_first(i, j), by_second(i, j));
      }
    }
  }

  /// Traces back from the last points. If no triangulation has only positive triangles, some are not
  /// positive.
  std::vector<ZipperTriangle> found() {
    std::vector<ZipperTriangle> triangles;
    std::size_t i = first_.size() - 1, j = second_.size() - 1;
    while (!begins(i, j)) {
      const bool on_first = j == 0 || (i > 0 && by_first(i, j) <= by_second(i, j));
      i -= on_first ? 1 : 0;
      j -= on_first ? 0 : 1;
      triangles.push_back({on_first, static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
    }
    std::ranges::reverse(triangles);
    return triangles;
  }

 private:
  /// Whether there is no triangle yet; if the polylines share their first point, the first triangle has an
  /// edge of the second.
  bool begins(std::size_t i, std::size_t j) const { return j == 0 && (i == 0 || (closed_ && i == 1)); }
  double& at(std::size_t i, std::size_t j) { return cost_[i * second_.size() + j]; }

  double turned(Point a, Point b, Point c) const { return cost_of(a, b, c, left_); }
  /// The least cost of the strip up to points i and j whose last triangle is on an edge of the first line.
  double by_first(std::size_t i, std::size_t j) {
    if (i == 0) return infinite;
    return at(i - 1, j) + turned(first_[i - 1], first_[i], second_[j]);
  }
  double by_second(std::size_t i, std::size_t j) {
    if (j == 0) return infinite;
    return at(i, j - 1) + turned(first_[i], second_[j], second_[j - 1]);
  }

  std::span<const Point> first_, second_;
  bool left_, closed_;
  std::vector<double> cost_;
};

}  // namespace

std::vector<ZipperTriangle> zipper(std::span<const Point> first, std::span<const Point> second, bool left) {
  return Zipper(first, second, left).found();
}

}  // namespace quadloop
