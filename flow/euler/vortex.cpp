#include "flow/euler/vortex.hpp"

#include <cmath>
#include <numbers>

namespace quadloop::flow::euler {

State Vortex::state(Point at, double time) const {
  const double strength =
      5 / std::sqrt(gas.gamma);  // the usual 5 is for speeds in units of sqrt(pressure / density)
  const double x = (at.x - centre.x - free_stream[1] * time) / radius,
               y = (at.y - centre.y - free_stream[2] * time) / radius;
  const double turning = strength / (2 * std::numbers::pi) * std::exp(0.5 * (1 - x * x - y * y));
  const double temperature = 1 - 0.5 * (gas.gamma - 1) * turning * turning;
  const double density = free_stream[0] * std::pow(temperature, 1 / (gas.gamma - 1));
  return {density, free_stream[1] - turning * y, free_stream[2] + turning * x,
          free_stream[3] * density / free_stream[0] * temperature};
}

}  // namespace quadloop::flow::euler
