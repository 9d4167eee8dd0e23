#pragma once

#include <cmath>

#include "flow/euler/model/gas.hpp"
#include "mesher/geometry/point.hpp"
#include "tests/mesh/grid_mesh.hpp"

namespace quadloop::test {

/// One of many unlike states, none near a vacuum.
inline flow::euler::State made_up_state(int number) {
  const auto part = [&](int which) { return scattered(3, number, which); };
  return {1 + 0.6 * part(0), 1.5 * part(1), 1.5 * part(2), 0.7 + 0.5 * part(3)};
}
/// One of many unlike unit vectors.
inline Point made_up_normal(int number) {
  const double angle = 4 * scattered(4, number, 0);
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace quadloop::test
