#pragma once

#include <array>

#include "mesher/geometry/point.hpp"

namespace quadloop::adapt {

/// A symmetric 2 x 2 matrix.
struct Symmetric {
  double xx = 0, xy = 0, yy = 0;

  friend constexpr bool operator==(const Symmetric&, const Symmetric&) = default;
  friend constexpr Symmetric operator+(const Symmetric& a, const Symmetric& b) {
    return {a.xx + b.xx, a.xy + b.xy, a.yy + b.yy};
  }
  friend constexpr Symmetric operator*(double s, const Symmetric& a) {
    return {s * a.xx, s * a.xy, s * a.yy};
  }
};

/// Eigenvalues, the larger first, and the unit eigenvector of the larger one.
struct Eigen2 {
  double larger = 0, smaller = 0;
  Point axis{1, 0};
};
Eigen2 eigen_of(const Symmetric& s);
Symmetric symmetric_of(const Eigen2& e);

/// A metric: a positive definite matrix in 1 / length^2, in which an edge e has the length sqrt(e^T m e). A
/// mesh that conforms to it has edges of length 1 (Loseille and Alauzet, SIAM J. Numer. Anal. 49, 2011).
struct Metric : Symmetric {
  constexpr Metric() : Symmetric{1, 0, 1} {}
  constexpr explicit Metric(const Symmetric& s) : Symmetric{s} {}
};

/// The logarithm of a metric, used for interpolation (Arsigny et al., Magn. Reson. Med. 56, 2006).
struct LogMetric : Symmetric {
  constexpr LogMetric() = default;
  constexpr explicit LogMetric(const Symmetric& s) : Symmetric{s} {}
};
LogMetric log_of(const Metric& m);
Metric exp_of(const LogMetric& m);

/// The isotropic metric for edges of this length.
Metric isotropic(double size);

/// The squared length of an edge in a constant metric.
constexpr double squared_length(const Symmetric& m, Point e) {
  return m.xx * e.x * e.x + 2 * m.xy * e.x * e.y + m.yy * e.y * e.y;
}
/// The length of an edge along which the size changes in geometric progression from one metric to the other
/// (Alauzet, Finite Elem. Anal. Des. 46, 2010).
double length_between(const Metric& at_from, const Metric& at_to, Point edge);

/// The square root of the determinant: approximately the number of nodes per unit of area.
double density_of(const Metric& m);

/// The metric of the largest ellipse within both, by simultaneous reduction: sizes are at most those of
/// either metric in any direction.
Metric intersection(const Metric& a, const Metric& b);

/// The metric that `m`, at a distance `edge`, allows here if sizes may grow by `slope` per unit of length: a
/// mean of growth in physical space, which reduces anisotropy, and in metric space (Alauzet 2010, mixed
/// space).
Metric grown(const Metric& m, Point edge, double slope);

/// Quality of a triangle in a metric: 4 sqrt(3) area / (sum of squared edges), both in the metric; 1 for an
/// equilateral triangle, 0 or less for a flat or inverted one.
double quality_in(const Symmetric& m, Point a, Point b, Point c);

}  // namespace quadloop::adapt
