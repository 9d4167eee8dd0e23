#include "mesher/geometry/assemble/naca_airfoil.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "mesher/base/error.hpp"
#include "mesher/geometry/assemble/naca_section.hpp"
#include "mesher/geometry/assemble/transform.hpp"

namespace quadloop {

namespace {

using Parts = std::vector<std::vector<Point>>;

/// The place between `low` and `high` above which `is_above` is true.
template <class Predicate>
double bisected(double low, double high, const Predicate& is_above) {
  constexpr int to_rounding = 60;
  for (int i = 0; i < to_rounding; ++i) {
    const double middle = 0.5 * (low + high);
    (is_above(middle) ? high : low) = middle;
  }
  return high;
}

/// One surface with a flap, from the leading to the trailing edge.
class FlappedSurface {
 public:
  FlappedSurface(const NacaSection& section, int side, const NacaAirfoil& airfoil, Point hinge)
      : section_{section}, side_{side}, airfoil_{airfoil}, hinge_{hinge}, nearest_{nearest_place()} {}

  bool hinge_is_inside() const { return side_ * (section_.point_at(nearest_, side_).y - hinge_.y) > 0; }

  Parts parts() const {
    const double degrees = airfoil_.flap_degrees;
    if (degrees == 0) return fixed_parts(1);
    return side_ * degrees > 0 ? opened() : closed();
  }

 private:
  Point arm(double x) const { return section_.point_at(x, side_) - hinge_; }
  double radius(double x) const { return length(arm(x)); }
  /// The point turned with a part of the flap angle.
  Point turned(Point p, double part) const {
    return turned_about(hinge_, p, unit_vector(-part * airfoil_.flap_degrees));
  }

  /// The place of the surface nearest to the hinge.
  double nearest_place() const {
    constexpr double h = 1e-4;
    return bisected(h, 1 - h, [&](double x) { return radius(x + h) > radius(x - h); });
  }

  /// From the leading edge to a place, divided where two formulas of the camber line meet.
  Parts fixed_parts(double to) const {
    constexpr double least = 0.05;  // of the chord, so that a part has points for a spline
    const double joint = section_.camber_joint();
    if (joint < least || to - joint < least) return {section_.surface(side_, 0, to, airfoil_.points)};
    return {section_.surface(side_, 0, joint, airfoil_.points),
            section_.surface(side_, joint, to, airfoil_.points)};
  }
  std::vector<Point> flap_part(double from) const {
    std::vector<Point> part = section_.surface(side_, from, 1, airfoil_.points);
    for (Point& p : part) p = turned(p, 1);
    return part;
  }

  /// The outer side of the bend: an arc about the hinge, tangent to both parts.
  Parts opened() const {
    constexpr double step_degrees = 2;
    const int steps =
        std::max(4, static_cast<int>(std::ceil(std::abs(airfoil_.flap_degrees) / step_degrees)));
    Parts parts = fixed_parts(nearest_);
    std::vector<Point> arc{parts.back().back()};
    for (int i = 1; i <= steps; ++i) arc.push_back(turned(arc.front(), static_cast<double>(i) / steps));
    parts.push_back(std::move(arc));
    parts.push_back(flap_part(nearest_));
    return parts;
  }

  /// The inner side: the flap's surface begins where it meets the fixed one, in a corner. The two places are
  /// at one distance from the hinge, in directions that differ by the flap angle.
  Parts closed() const {
    const double angle = std::abs(airfoil_.flap_degrees) * (std::numbers::pi / 180);
    const auto behind = [&](double fixed) {
      return bisected(nearest_, 1, [&](double x) { return radius(x) > radius(fixed); });
    };
    const auto is_near = [&](double fixed) {
      const Point a = arm(fixed), b = arm(behind(fixed));
      return std::abs(std::atan2(cross(a, b), dot(a, b))) < angle;
    };
    const double fixed = bisected(0, nearest_, is_near), flap = behind(fixed);
    constexpr double rounding = 1e-9;
    if (std::abs(radius(flap) - radius(fixed)) > rounding)
      throw InputError(
          fmt::format("the flap of '{}' cannot turn by {:g} degrees about ({:g}, {:g}); give a smaller "
                      "angle, or a hinge farther from the trailing edge",
                      airfoil_.code, airfoil_.flap_degrees, hinge_.x, hinge_.y));
    Parts parts = fixed_parts(fixed);
    parts.push_back(flap_part(flap));
    parts.back().front() = parts[parts.size() - 2].back();
    return parts;
  }

  const NacaSection& section_;
  int side_;
  const NacaAirfoil& airfoil_;
  Point hinge_;
  double nearest_;
};

Point hinge_of(const NacaAirfoil& airfoil, const NacaSection& section) {
  const std::vector<double>& hinge = airfoil.hinge;
  return {hinge[0], hinge.size() > 1 ? hinge[1] : section.camber_height(hinge[0])};
}

}  // namespace

std::vector<std::vector<Point>> smooth_parts(const NacaAirfoil& airfoil) {
  const NacaSection section(airfoil.code, airfoil.sharp);
  const Point hinge = hinge_of(airfoil, section);
  const FlappedSurface lower(section, -1, airfoil, hinge), upper(section, 1, airfoil, hinge);
  const bool is_inside = 0 < hinge.x && hinge.x < 1 && lower.hinge_is_inside() && upper.hinge_is_inside();
  if (airfoil.flap_degrees != 0 && !is_inside)
    throw InputError(fmt::format(
        "the hinge at ({:g}, {:g}) is not inside '{}'; give its place on the chord between 0 and 1, as in "
        "0.75, which puts it on the camber line",
        hinge.x, hinge.y, airfoil.code));
  Parts parts = lower.parts();
  std::ranges::reverse(parts);
  for (std::vector<Point>& part : parts) std::ranges::reverse(part);
  const Parts above = upper.parts();
  parts.back().insert(parts.back().end(), above.front().begin() + 1, above.front().end());
  parts.insert(parts.end(), above.begin() + 1, above.end());
  if (!airfoil.sharp) parts.push_back({parts.back().back(), parts.front().front()});
  return parts;
}

}  // namespace quadloop
