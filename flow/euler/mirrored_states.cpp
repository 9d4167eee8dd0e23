#include "flow/euler/mirrored_states.hpp"

#include <algorithm>
#include <utility>

namespace quadloop::flow::euler {

namespace {

/// Index of the velocity normal to the axis in a state.
std::size_t across(MirrorAxis axis) { return axis == MirrorAxis::x ? 2 : 1; }

}  // namespace

std::optional<MirroredStates> MirroredStates::find(const Communicator& comm, const DualMesh& mesh,
                                                   const FlowModel& model, MirrorAxis axis) {
  if (model.free_stream[across(axis)] != 0) return {};
  const std::span owned = std::span(mesh.halo().points()).first(mesh.owned_nodes());
  const std::int64_t first = comm.exclusive_sum(mesh.owned_nodes());
  NodeImages images = node_images(comm, first, owned, axis);
  const bool lacks = std::ranges::any_of(images, [](GlobalNodeId image) { return !image.valid(); });
  if (comm.any(lacks)) return {};
  return MirroredStates(comm, mesh, axis, std::move(images));
}

MirroredStates::MirroredStates(const Communicator& comm, const DualMesh& mesh, MirrorAxis axis,
                               NodeImages images)
    : comm_{&comm}, mesh_{&mesh}, axis_{axis}, images_{std::move(images)} {}

void MirroredStates::average(IdVector<NodeId, State>& states) const {
  const NodeOwners owners(*comm_, comm_->exclusive_sum(mesh_->owned_nodes()));
  std::vector<int> ranks;
  for (const GlobalNodeId image : images_) ranks.push_back(owners.rank_of(image));
  const Exchange exchange(*comm_, ranks);
  std::vector<State> answers;
  for (const GlobalNodeId asked : exchange.deliver(images_)) answers.push_back(states[owners.local(asked)]);
  IdVector<NodeId, State> of_images(exchange.answer(answers));
  for (const NodeId node : of_images.ids()) {
    State& state = states[node];
    of_images[node][across(axis_)] *= -1;
    for (std::size_t k = 0; k < state.size(); ++k) state[k] = 0.5 * (state[k] + of_images[node][k]);
  }
}

}  // namespace quadloop::flow::euler
