#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace quadloop {

/// -1, 0 or +1.
constexpr int sign(double value) { return (value > 0) - (value < 0); }

/// A position or a vector in the plane, in the geometry's unit of length.
struct Point {
  double x = 0, y = 0;

  friend constexpr bool operator==(const Point&, const Point&) = default;
  friend constexpr auto operator<=>(const Point&, const Point&) = default;  ///< by x, then by y
  friend constexpr Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
  friend constexpr Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
  friend constexpr Point operator*(double s, Point a) { return {s * a.x, s * a.y}; }
};

constexpr double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
/// The z component of the vector product. It is rounded: its sign must not decide topology (see
/// predicates.hpp).
constexpr double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
inline double length(Point a) { return std::sqrt(dot(a, a)); }

/// A closed axis-parallel rectangle. A default-constructed box is empty.
struct Box {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Point high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  constexpr void include(Point p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  constexpr void include(const Box& b) {
    low = {std::min(low.x, b.low.x), std::min(low.y, b.low.y)};
    high = {std::max(high.x, b.high.x), std::max(high.y, b.high.y)};
  }
  constexpr bool empty() const { return !(low.x <= high.x); }
  constexpr double width() const { return high.x - low.x; }
  constexpr double height() const { return high.y - low.y; }
  constexpr Point centre() const { return {0.5 * (low.x + high.x), 0.5 * (low.y + high.y)}; }
  constexpr bool contains(Point p) const {
    return low.x <= p.x && p.x <= high.x && low.y <= p.y && p.y <= high.y;
  }
  constexpr bool meets(const Box& b) const {
    return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y;
  }

  friend constexpr bool operator==(const Box&, const Box&) = default;
};

/// The box of a segment.
constexpr Box box_of(Point a, Point b) {
  return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}

}  // namespace quadloop
