#pragma once

#include <array>
#include <cstddef>

#include "adapt/sensor/recovery/hessians.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop::adapt {

/// Moments of points about a place: sums of dx^a dy^b for a + b <= 4, and of q dx^a dy^b for a + b <= 2,
/// where q is the value at the point minus a reference value of the place. They define the least-squares fit
/// of a quadratic, and can be converted to moments about any other place.
class Moments {
 public:
  void add(Point from_place, double value);
  /// Adds the moments `other`, taken about a place at `offset` from this one with a reference value larger by
  /// `rise`, multiplied by `weight`.
  void add(const Moments& other, Point offset, double rise, double weight);

  /// The second derivatives of the best-fitting quadratic; 0 for a derivative that the points do not
  /// determine, or that changes the quadratic by less than `rounding` over the points' distance.
  Hessian hessian(double rounding) const;

 private:
  static constexpr std::size_t index(std::size_t a, std::size_t b) { return (a + b) * (a + b + 1) / 2 + b; }

  std::array<double, 15> places_{};
  std::array<double, 6> values_{};
};

}  // namespace quadloop::adapt
