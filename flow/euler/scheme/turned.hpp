#pragma once

#include <array>

#include "mesher/geometry/point.hpp"

namespace quadloop::flow::euler {

/// Turns a vector counter-clockwise by the angle with this cosine and sine.
inline Point turned(Point v, Point direction) {
  return {direction.x * v.x - direction.y * v.y, direction.y * v.x + direction.x * v.y};
}

/// Turns the vector in a state, a flux or a change of conserved variables: the second and third entries.
template <class Real>
std::array<Real, 4> turned(const std::array<Real, 4>& row, Point direction) {
  const Point v = turned(Point{row[1], row[2]}, direction);
  return {row[0], static_cast<Real>(v.x), static_cast<Real>(v.y), row[3]};
}

}  // namespace quadloop::flow::euler
