#include "flow/euler/scheme/no_slip.hpp"

#include <algorithm>

namespace quadloop::flow::euler {

NoSlipNodes::NoSlipNodes(const DualMesh& mesh, const FlowModel& model) : gamma_{model.gas.gamma} {
  for (const BoundaryFace& face : mesh.faces()) {
    const BoundaryModel& boundary = model.boundaries[face.boundary];
    if (boundary.condition != Condition::no_slip) continue;
    const double energy = boundary.temperature.value_or(0) / (gamma_ * (gamma_ - 1));
    for (const NodeId node : {face.from, face.to}) {
      if (mesh.is_owned(node)) nodes_.push_back({node, energy});
    }
  }
  // where two walls meet, the hotter one counts
  std::ranges::sort(nodes_, [](const Node& a, const Node& b) {
    return a.node != b.node ? a.node < b.node : a.energy > b.energy;
  });
  const auto same = std::ranges::unique(nodes_, {}, &Node::node);
  nodes_.erase(same.begin(), same.end());
}

void NoSlipNodes::hold(IdVector<NodeId, State>& states) const {
  for (const Node& node : nodes_) {
    State& state = states[node.node];
    state[1] = state[2] = 0;
    if (node.energy > 0) state[3] = (gamma_ - 1) * node.energy * state[0];
  }
}

void NoSlipNodes::take_friction(IdVector<NodeId, Flux>& sums, IdVector<NodeId, Point>& friction) const {
  for (const Node& node : nodes_) {
    Flux& sum = sums[node.node];
    friction[node.node] = {sum[1], sum[2]};
    sum[1] = sum[2] = 0;
    if (node.energy > 0) sum[3] = 0;
  }
}

IdVector<NodeId, char> NoSlipNodes::held_rows(std::size_t nodes) const {
  IdVector<NodeId, char> last(nodes, 0);
  for (const Node& node : nodes_) last[node.node] = node.energy > 0 ? 3 : 2;
  return last;
}

void NoSlipNodes::hold(IdVector<NodeId, Matrix4>& diagonal) const {
  for (const Node& node : nodes_) {
    Matrix4& block = diagonal[node.node];
    const std::size_t last = node.energy > 0 ? 3 : 2;
    for (std::size_t row = 1; row <= last; ++row) {
      for (std::size_t column = 0; column < 4; ++column) block[4 * row + column] = row == column ? 1 : 0;
    }
    if (node.energy > 0) block[12] = -node.energy;
  }
}

}  // namespace quadloop::flow::euler
