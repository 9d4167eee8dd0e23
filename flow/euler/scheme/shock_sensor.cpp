#include "flow/euler/scheme/shock_sensor.hpp"

namespace quadloop::flow::euler {

ShockSensor::ShockSensor(const DualMesh& mesh, double least_pressure)
    : mesh_{mesh}, least_pressure_{least_pressure}, jumps_(mesh.nodes()), shares_(mesh.nodes()) {}

void ShockSensor::find(const IdVector<NodeId, State>& states) {
  if (frozen_) return;
  std::ranges::fill(jumps_, 0.0);
  for (const DualEdge& edge : mesh_.edges()) {
    const double jump = pressure_jump(states[edge.low][3], states[edge.high][3], least_pressure_);
    jumps_[edge.low] = std::max(jumps_[edge.low], jump);
    jumps_[edge.high] = std::max(jumps_[edge.high], jump);
  }
  for (const NodeId node : mesh_.owned_ids()) shares_[node] = shock_share(jumps_[node]);
  mesh_.exchange().update(shares_);
}

}  // namespace quadloop::flow::euler
