#pragma once

#include <array>
#include <cmath>
#include <cstddef>

namespace quadloop::flow::euler {

/// A number with its derivatives with respect to `count` variables: computing with such numbers instead of
/// doubles gives exact derivatives (forward-mode automatic differentiation). Comparisons use the value only,
/// so a function with branches gets the derivative of the branch taken.
template <std::size_t count>
struct DualNumber {
  double value = 0;
  std::array<double, count> slopes{};

  constexpr DualNumber() = default;
  constexpr DualNumber(double constant) : value{constant} {}  // implicit, as for doubles
  /// The k-th variable.
  static constexpr DualNumber variable(double value, std::size_t k) {
    DualNumber number(value);
    number.slopes[k] = 1;
    return number;
  }

  friend constexpr DualNumber operator+(const DualNumber& a, const DualNumber& b) {
    return combined(a.value + b.value, 1, a, 1, b);
  }
  friend constexpr DualNumber operator-(const DualNumber& a, const DualNumber& b) {
    return combined(a.value - b.value, 1, a, -1, b);
  }
  friend constexpr DualNumber operator*(const DualNumber& a, const DualNumber& b) {
    return combined(a.value * b.value, b.value, a, a.value, b);
  }
  friend constexpr DualNumber operator/(const DualNumber& a, const DualNumber& b) {
    const double value = a.value / b.value;
    return combined(value, 1 / b.value, a, -value / b.value, b);
  }
  friend constexpr DualNumber operator-(const DualNumber& a) { return combined(-a.value, -1, a, 0, a); }
  friend constexpr bool operator<(const DualNumber& a, const DualNumber& b) { return a.value < b.value; }
  friend constexpr bool operator>(const DualNumber& a, const DualNumber& b) { return a.value > b.value; }
  friend constexpr bool operator<=(const DualNumber& a, const DualNumber& b) { return a.value <= b.value; }
  friend constexpr bool operator>=(const DualNumber& a, const DualNumber& b) { return a.value >= b.value; }

  friend DualNumber sqrt(const DualNumber& a) {
    const double root = std::sqrt(a.value);
    return combined(root, 0.5 / root, a, 0, a);
  }
  friend DualNumber pow(const DualNumber& a, double power) {
    const double value = std::pow(a.value, power);
    return combined(value, power * value / a.value, a, 0, a);
  }
  friend DualNumber abs(const DualNumber& a) { return a.value < 0 ? -a : a; }

 private:
  static constexpr DualNumber combined(double value, double of_a, const DualNumber& a, double of_b,
                                       const DualNumber& b) {
    DualNumber result(value);
    for (std::size_t k = 0; k < count; ++k) result.slopes[k] = of_a * a.slopes[k] + of_b * b.slopes[k];
    return result;
  }
};

/// A plane vector of any number type.
template <class Real>
struct VectorOf {
  Real x{}, y{};
};

}  // namespace quadloop::flow::euler
