#pragma once

#include <array>
#include <cstddef>

#include "adapt/sensor/recovery/hessians.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

/// Sums over points about a place: of dx^a dy^b for a + b <= 4, and of q dx^a dy^b for a + b <= 2, q being
/// the value at the point less one that belongs to the place. All that a least-squares fit of a quadratic
/// needs, and whoever knows them about one place knows them about any other.
class Moments {
 public:
  void add(Point from_place, double value);
  /// Those of `other`, made about a place that lies `offset` from this one and whose value is larger by
  /// `rise`, `weight` times.
  void add(const Moments& other, Point offset, double rise, double weight);

  /// The second derivatives of the quadratic that fits the points best; one that they do not tell is 0. Those
  /// that lift the quadratic by less than `rounding` over the points' distance are 0.
  Hessian hessian(double rounding) const;

 private:
  static constexpr std::size_t index(std::size_t a, std::size_t b) { return (a + b) * (a + b + 1) / 2 + b; }

  std::array<double, 15> places_{};
  std::array<double, 6> values_{};
};

}  // namespace quadloop
