#pragma once

#include <cmath>

namespace quadloop::io {

/// A position or a vector in space, in the geometry's unit of length.
struct Point3 {
  double x = 0, y = 0, z = 0;

  friend constexpr bool operator==(const Point3&, const Point3&) = default;
  friend constexpr Point3 operator+(Point3 a, Point3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend constexpr Point3 operator-(Point3 a, Point3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend constexpr Point3 operator*(double s, Point3 a) { return {s * a.x, s * a.y, s * a.z}; }
};

constexpr double dot(Point3 a, Point3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Point3 cross(Point3 a, Point3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Point3 a) { return std::sqrt(dot(a, a)); }

}  // namespace quadloop::io
