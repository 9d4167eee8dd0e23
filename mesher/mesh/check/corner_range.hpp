#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "mesher/geometry/point.hpp"

namespace quadloop {

/// A cell's corner, which can be compared without computing its angle.
struct CellCorner {
  double cross, dot;  ///< of the sides to the next and to the previous node

  CellCorner(Point previous, Point p, Point next)
      : cross{quadloop::cross(next - p, previous - p)}, dot{quadloop::dot(next - p, previous - p)} {}
  /// Angle: 0 to 180 if the corner turns left, negative if it is inverted.
  double degrees() const { return std::atan2(cross, dot) * (180 / std::numbers::pi); }
};

/// The smallest and the largest of many angles. Corners that are certainly in between are skipped by their
/// cotangents, as the inverse tangent costs ten times as much. Bitwise independent of the order.
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
    if (!(corner.cross > 0)) {  // no cotangent bound is valid: all other corners are measured
      most_cotangent_ = -std::numeric_limits<double>::infinity();
      least_cotangent_ = -most_cotangent_;
    }
  }
  /// Degrees; plus and minus infinity if there is no corner.
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
         /// Bounds of the corners that may be skipped.
      least_cotangent_ = std::numeric_limits<double>::infinity();
};

}  // namespace quadloop
