#include "adapt/sensor/recovery/moments.hpp"

#include <cmath>

namespace quadloop::adapt {

namespace {

constexpr std::size_t highest = 4, unknowns = 6;
constexpr double binomial[highest + 1][highest + 1] = {
    {1, 0, 0, 0, 0}, {1, 1, 0, 0, 0}, {1, 2, 1, 0, 0}, {1, 3, 3, 1, 0}, {1, 4, 6, 4, 1}};

using Powers = std::array<double, highest + 1>;
Powers powers(double x) { return {1, x, x * x, x * x * x, (x * x) * (x * x)}; }

/// 1, dx, dy, dx^2 / 2, dx dy, dy^2 / 2.
struct Term {
  std::size_t a, b;
  double factor;
};
constexpr std::array<Term, unknowns> terms{
    {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}, {2, 0, 0.5}, {1, 1, 1}, {0, 2, 0.5}}};

struct NormalEquations {
  std::array<std::array<double, unknowns>, unknowns> matrix{};
  std::array<double, unknowns> right{};

  /// Scales each unknown so that its diagonal entry is 1; unknowns with zero diagonal are unchanged.
  std::array<double, unknowns> scale() {
    std::array<double, unknowns> units{};
    for (std::size_t i = 0; i < unknowns; ++i) units[i] = matrix[i][i] > 0 ? 1 / std::sqrt(matrix[i][i]) : 0;
    for (std::size_t i = 0; i < unknowns; ++i) {
      right[i] *= units[i];
      for (std::size_t j = 0; j < unknowns; ++j) matrix[i][j] *= units[i] * units[j];
    }
    return units;
  }

  /// Solves by elimination; an unknown that depends linearly on the previous ones is 0.
  std::array<double, unknowns> solution() {
    constexpr double nothing = 1e-12;  // relative to 1: the points do not determine the unknown
    for (std::size_t k = 0; k < unknowns; ++k) {
      if (matrix[k][k] <= nothing) continue;
      for (std::size_t i = k + 1; i < unknowns; ++i) {
        const double share = matrix[i][k] / matrix[k][k];
        for (std::size_t j = k; j < unknowns; ++j) matrix[i][j] -= share * matrix[k][j];
        right[i] -= share * right[k];
      }
    }
    std::array<double, unknowns> found{};
    for (std::size_t k = unknowns; k-- > 0;) {
      if (matrix[k][k] <= nothing) continue;
      double rest = right[k];
      for (std::size_t j = k + 1; j < unknowns; ++j) rest -= matrix[k][j] * found[j];
      found[k] = rest / matrix[k][k];
    }
    return found;
  }
};

}  // namespace

void Moments::add(Point from_place, double value) {
  const Powers x = powers(from_place.x), y = powers(from_place.y);
  for (std::size_t a = 0; a <= highest; ++a) {
    for (std::size_t b = 0; a + b <= highest; ++b) {
      places_[index(a, b)] += x[a] * y[b];
      if (a + b <= 2) values_[index(a, b)] += value * (x[a] * y[b]);
    }
  }
}

void Moments::add(const Moments& other, Point offset, double rise, double weight) {
  const Powers x = powers(offset.x), y = powers(offset.y);
  for (std::size_t a = 0; a <= highest; ++a) {
    for (std::size_t b = 0; a + b <= highest; ++b) {
      double place = 0, value = 0;
      for (std::size_t p = 0; p <= a; ++p) {
        for (std::size_t q = 0; q <= b; ++q) {
          const double factor = binomial[a][p] * binomial[b][q] * (x[a - p] * y[b - q]);
          place += factor * other.places_[index(p, q)];
          if (a + b <= 2) value += factor * other.values_[index(p, q)];
        }
      }
      places_[index(a, b)] += weight * place;
      if (a + b <= 2) values_[index(a, b)] += weight * (value + rise * place);
    }
  }
}

Hessian Moments::hessian(double rounding) const {
  const double points = places_[index(0, 0)], squares = places_[index(2, 0)] + places_[index(0, 2)];
  if (!(points > 0 && squares > 0)) return {};
  const double unit = std::sqrt(squares / points);
  const Powers scale = powers(1 / unit);
  NormalEquations equations;
  for (std::size_t i = 0; i < unknowns; ++i) {
    const auto [a, b, factor] = terms[i];
    equations.right[i] = factor * scale[a + b] * values_[index(a, b)];
    for (std::size_t j = 0; j < unknowns; ++j) {
      const auto [c, d, other] = terms[j];
      equations.matrix[i][j] = factor * other * (scale[a + b] * scale[c + d]) * places_[index(a + c, b + d)];
    }
  }
  const std::array<double, unknowns> units = equations.scale();
  const std::array<double, unknowns> found = equations.solution();
  const Hessian lift{found[3] * units[3], found[4] * units[4], found[5] * units[5]};
  if (!(largest_eigenvalue(lift) > rounding)) return {};
  return 1 / (unit * unit) * lift;
}

}  // namespace quadloop::adapt
