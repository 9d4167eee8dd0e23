#include "mesher/geometry/turn.hpp"

#include <cmath>
#include <numbers>

namespace quadloop {

Point unit_vector(double degrees) {
  const double turn = std::remainder(degrees, 360.0);  // exact, in -180 .. 180
  if (turn == 0) return {1, 0};
  if (turn == 90) return {0, 1};
  if (turn == -90) return {0, -1};
  if (std::abs(turn) == 180) return {-1, 0};
  const double radians = turn * (std::numbers::pi / 180);
  return {std::cos(radians), std::sin(radians)};
}

Point turned_about(Point about, Point p, Point direction) {
  const Point arm = p - about;
  return about + Point{direction.x * arm.x - direction.y * arm.y, direction.y * arm.x + direction.x * arm.y};
}

}  // namespace quadloop
