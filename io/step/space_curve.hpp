#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace quadloop::io {

/// A position or a vector in space.
struct SpacePoint {
  std::array<double, 3> at{};

  friend bool operator==(const SpacePoint&, const SpacePoint&) = default;
  friend SpacePoint operator+(const SpacePoint& a, const SpacePoint& b) {
    return {{a.at[0] + b.at[0], a.at[1] + b.at[1], a.at[2] + b.at[2]}};
  }
  friend SpacePoint operator-(const SpacePoint& a, const SpacePoint& b) {
    return {{a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2]}};
  }
  friend SpacePoint operator*(double s, const SpacePoint& a) {
    return {{s * a.at[0], s * a.at[1], s * a.at[2]}};
  }
};

inline double dot(const SpacePoint& a, const SpacePoint& b) {
  return a.at[0] * b.at[0] + a.at[1] * b.at[1] + a.at[2] * b.at[2];
}
inline double length(const SpacePoint& a) { return std::sqrt(dot(a, a)); }
SpacePoint cross(const SpacePoint& a, const SpacePoint& b);

/// An arc of an ellipse: centre + cos(t) major + sin(t) minor for t from `begin` to `end` > `begin`, in
/// radians.
struct SpaceArc {
  SpacePoint centre, major, minor;
  double begin = 0, end = 0;

  SpacePoint point_at(double t) const;
  /// The parameter of the point of the whole ellipse that is nearest to p if p is on it; from -pi to pi.
  double parameter_of(const SpacePoint& p) const;
};

/// A B-spline: poles.size() + degree + 1 knots in ascending order; weights for each pole, or none. Degree 1
/// with simple inner knots: a polyline.
struct SpaceSpline {
  int degree = 1;
  std::vector<double> knots;
  std::vector<SpacePoint> poles;
  std::vector<double> weights;

  double begin() const { return knots[degree]; }
  double end() const { return knots[poles.size()]; }
  /// The point at a parameter of the range; exactly the pole at an end with repeated knots.
  SpacePoint point_at(double t) const;
};

/// A polyline with knots 0, 1, 2, ...
SpaceSpline polyline(std::vector<SpacePoint> points);

/// Why a B-spline is not well formed, for messages; empty if it is (see fault_of() of curved_chain.hpp; in
/// addition no inner knot has a multiplicity above the degree).
std::string fault_of(const SpaceSpline& spline);

/// The part of a well-formed B-spline between two parameters of its range, from < to, by inserted knots
/// (Boehm 1980). O((n + degree) degree) for n poles.
SpaceSpline part_of(SpaceSpline spline, double from, double to);

/// The parameter of the point of a well-formed B-spline that is nearest to p; accurate to rounding if p is on
/// the curve. O(n degree) if few intervals of the curve are near p.
double nearest_parameter(const SpaceSpline& spline, const SpacePoint& p);

/// A curve of bounded length, with the coordinates of its ends, which may differ from the exact ones by the
/// rounding of the file. The ends are equal if it is closed.
struct SpaceCurve {
  std::variant<SpaceSpline, SpaceArc> shape;
  SpacePoint first, last;
};

/// Points that are not in a plane unless the curve is: the poles of a B-spline, points of an arc.
std::vector<SpacePoint> sample_of(const SpaceCurve& curve);

}  // namespace quadloop::io
