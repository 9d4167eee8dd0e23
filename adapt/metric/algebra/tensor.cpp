#include "adapt/metric/algebra/tensor.hpp"

#include <algorithm>
#include <cmath>

namespace quadloop::adapt {

Eigen2 eigen_of(const Symmetric& s) {
  const double mean = 0.5 * (s.xx + s.yy), half = 0.5 * (s.xx - s.yy), spread = std::hypot(half, s.xy);
  if (spread == 0) return {mean, mean, {1, 0}};
  // Uses the expression for the eigenvector without cancellation.
  const Point v = half >= 0 ? Point{half + spread, s.xy} : Point{s.xy, spread - half};
  const double size = length(v);
  return {mean + spread, mean - spread, {v.x / size, v.y / size}};
}

Symmetric symmetric_of(const Eigen2& e) {
  const double x = e.axis.x, y = e.axis.y;
  return {e.larger * x * x + e.smaller * y * y, (e.larger - e.smaller) * x * y,
          e.larger * y * y + e.smaller * x * x};
}

namespace {

template <class Function>
Symmetric mapped(const Symmetric& s, const Function& function) {
  const Eigen2 e = eigen_of(s);
  return symmetric_of({function(e.larger), function(e.smaller), e.axis});
}

/// The product a b a, which is symmetric.
Symmetric framed(const Symmetric& a, const Symmetric& b) {
  const double p = a.xx * b.xx + a.xy * b.xy, q = a.xx * b.xy + a.xy * b.yy;
  const double r = a.xy * b.xx + a.yy * b.xy, t = a.xy * b.xy + a.yy * b.yy;
  return {p * a.xx + q * a.xy, p * a.xy + q * a.yy, r * a.xy + t * a.yy};
}

}  // namespace

LogMetric log_of(const Metric& m) {
  // The smaller eigenvalue by the determinant, as it may be far below the larger one.
  const Eigen2 e = eigen_of(m);
  const double smaller = std::max((m.xx * m.yy - m.xy * m.xy) / e.larger, 0x1p-48 * e.larger);
  return LogMetric{symmetric_of({std::log(e.larger), std::log(smaller), e.axis})};
}

Metric exp_of(const LogMetric& m) {
  return Metric{mapped(m, [](double value) { return std::exp(value); })};
}

Metric isotropic(double size) {
  const double value = 1 / (size * size);
  return Metric{{value, 0, value}};
}

double length_between(const Metric& at_from, const Metric& at_to, Point edge) {
  const double from = std::sqrt(squared_length(at_from, edge)), to = std::sqrt(squared_length(at_to, edge));
  const double ratio = from / to;
  if (std::abs(ratio - 1) < 1e-3) return 0.5 * (from + to);
  return from * (ratio - 1) / (ratio * std::log(ratio));
}

double density_of(const Metric& m) { return std::sqrt(std::max(m.xx * m.yy - m.xy * m.xy, 0.0)); }

Metric intersection(const Metric& a, const Metric& b) {
  const Symmetric root = mapped(a, [](double value) { return std::sqrt(value); });
  const Symmetric inverse = mapped(a, [](double value) { return 1 / std::sqrt(value); });
  const Eigen2 e = eigen_of(framed(inverse, b));
  if (!(e.larger > 1)) return a;
  return Metric{framed(root, symmetric_of({e.larger, std::max(e.smaller, 1.0), e.axis}))};
}

Metric grown(const Metric& m, Point edge, double slope) {
  constexpr double in_plane = 0.125;
  const double distance = length(edge);
  const double by_metric = 1 + slope * std::sqrt(squared_length(m, edge));
  return Metric{mapped(m, [&](double value) {
    const double by_plane = 1 + slope * std::sqrt(value) * distance;
    const double factor = std::pow(by_plane, in_plane) * std::pow(by_metric, 1 - in_plane);
    return value / (factor * factor);
  })};
}

double quality_in(const Symmetric& m, Point a, Point b, Point c) {
  constexpr double for_equilateral = 3.4641016151377544;  // 2 sqrt(3), multiplied by twice the area
  const double sum = squared_length(m, b - a) + squared_length(m, c - b) + squared_length(m, a - c);
  const double determinant = std::max(m.xx * m.yy - m.xy * m.xy, 0.0);
  return for_equilateral * std::sqrt(determinant) * cross(b - a, c - a) / sum;
}

}  // namespace quadloop::adapt
