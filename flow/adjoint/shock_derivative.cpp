#include "flow/adjoint/shock_derivative.hpp"

#include <utility>

#include "flow/euler/model/dual_number.hpp"

namespace quadloop::flow::euler {

ShockDerivative::ShockDerivative(const Communicator& comm, const DualMesh& mesh, const ShockSensor& sensor,
                                 const IdVector<NodeId, State>& states)
    : mesh_{mesh}, parts_(mesh.owned_nodes()) {
  using Dual = DualNumber<2>;
  bool acts = false;
  for (const DualEdge& edge : mesh.edges()) {
    for (const auto& [node, other] : {std::pair{edge.low, edge.high}, {edge.high, edge.low}}) {
      if (sensor.frozen() || !mesh.is_owned(node) || parts_[node].neighbour.valid()) continue;
      const Dual jump = pressure_jump(Dual::variable(states[node][3], 0), Dual::variable(states[other][3], 1),
                                      sensor.least_pressure());
      if (jump.value != sensor.jump(node)) continue;
      const Dual share = shock_share(jump);
      parts_[node] = {share.slopes[0], share.slopes[1], other};
      acts = acts || share.slopes[0] != 0;
    }
  }
  acts_ = comm.any(acts);
}

IdVector<NodeId, double> ShockDerivative::apply(const IdVector<NodeId, State>& change) const {
  IdVector<NodeId, double> shares(mesh_.nodes());
  for (const NodeId node : parts_.ids()) {
    const Part& part = parts_[node];
    if (part.neighbour.valid())
      shares[node] = part.by_own * change[node][3] + part.by_neighbour * change[part.neighbour][3];
  }
  mesh_.exchange().update(shares);
  return shares;
}

namespace {

/// Contribution of a node's share to the neighbour with the deciding pressure.
struct HandedWeight {
  GlobalNodeId to;
  double weight = 0;
};

}  // namespace

void ShockDerivative::add_transposed(const IdVector<NodeId, double>& weights,
                                     IdVector<NodeId, State>& sums) const {
  IdVector<NodeId, HandedWeight> handed(mesh_.nodes());
  for (const NodeId node : parts_.ids()) {
    const Part& part = parts_[node];
    if (!part.neighbour.valid()) continue;
    sums[node][3] += part.by_own * weights[node];
    handed[node] = {mesh_.global(part.neighbour), part.by_neighbour * weights[node]};
  }
  mesh_.exchange().update(handed);
  for (const DualEdge& edge : mesh_.edges()) {
    for (const auto& [from, to] : {std::pair{edge.low, edge.high}, {edge.high, edge.low}}) {
      if (mesh_.is_owned(to) && handed[from].to == mesh_.global(to)) sums[to][3] += handed[from].weight;
    }
  }
}

}  // namespace quadloop::flow::euler
