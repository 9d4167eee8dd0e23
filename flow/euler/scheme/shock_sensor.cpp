#include "flow/euler/scheme/shock_sensor.hpp"

#include <algorithm>
#include <cmath>

namespace quadloop::euler {

namespace {

constexpr double weakest = 0.7,
                 range = 1;  ///< jumps at which the least speed begins to grow; until it is full
constexpr double largest_share = 0.3;

/// Rises from 0 to 1 between 0 and 1, smoothly.
double ramp(double x) {
  const double kept = std::clamp(x, 0.0, 1.0);
  return kept * kept * (3 - 2 * kept);
}

}  // namespace

ShockSensor::ShockSensor(const DualMesh& mesh, double least_pressure)
    : mesh_{mesh}, least_pressure_{least_pressure}, jumps_(mesh.nodes()), shares_(mesh.nodes()) {}

void ShockSensor::find(const std::vector<State>& states) {
  if (frozen_) return;
  std::ranges::fill(jumps_, 0.0);
  for (const DualEdge& edge : mesh_.edges()) {
    const double low = states[edge.low][3], high = states[edge.high][3],
                 jump = std::abs(high - low) / std::max(least_pressure_, std::min(low, high));
    jumps_[edge.low] = std::max(jumps_[edge.low], jump);
    jumps_[edge.high] = std::max(jumps_[edge.high], jump);
  }
  for (std::int32_t node = 0; node < mesh_.owned_nodes(); ++node)
    shares_[node] = largest_share * ramp((jumps_[node] - weakest) / range);
  mesh_.exchange().update(shares_);
}

double ShockSensor::least_middle(const DualEdge& edge) const {
  return std::max(shares_[edge.low], shares_[edge.high]);
}

}  // namespace quadloop::euler
