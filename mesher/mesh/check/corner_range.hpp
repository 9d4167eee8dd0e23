#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A cell's corner, as it can be compared without its angle.
struct CellCorner {
  double cross, dot;  ///< of the sides to the next node and to the previous one

  CellCorner(Point previous, Point p, Point next)
      : cross{quadloop::cross(next - p, previous - p)}, dot{quadloop::dot(next - p, previous - p)} {}
  /// 0 to 180 where the corner turns left, negative where it is inverted.
  double degrees() const { return std::atan2(cross, dot) * (180 / std::numbers::pi); }
};

/// The smallest and the largest of many corners' angles: those that surely lie between are passed over by
/// their cotangents, the inverse tangent, which costs ten times as much, is taken of the others alone. The
/// same bits in any order.
class CornerRange {
 public:
  void include(const CellCorner& corner) {
    if (lies_within(corner)) return;
    const double degrees = corner.degrees();
    if (degrees < smallest_) {
      smallest_ = degrees;
      most_cotangent_ = below(corner.dot / corner.cross);
    }
    if (degrees > largest_) {
      largest_ = degrees;
      least_cotangent_ = above(corner.dot / corner.cross);
    }
    if (!(corner.cross > 0)) {  // no cotangent tells what lies beside it: all others are measured
      most_cotangent_ = -std::numeric_limits<double>::infinity();
      least_cotangent_ = -most_cotangent_;
    }
  }
  /// Degrees; infinite, and minus that, of no corner.
  double smallest() const { return smallest_; }
  double largest() const { return largest_; }

 private:
  static constexpr double rounding = 1e-12;

  static double below(double x) { return x - rounding * (1 + std::abs(x)); }
  static double above(double x) { return x + rounding * (1 + std::abs(x)); }
  bool lies_within(const CellCorner& corner) const {
    return corner.cross > 0 && corner.dot < most_cotangent_ * corner.cross &&
           corner.dot > least_cotangent_ * corner.cross;
  }

  double smallest_ = std::numeric_limits<double>::infinity(),
         largest_ = -std::numeric_limits<double>::infinity();
  double most_cotangent_ = -std::numeric_limits<double>::infinity(),
         least_cotangent_ = std::numeric_limits<double>::infinity();  ///< of corners that may be passed over
};

}  // namespace quadloop
