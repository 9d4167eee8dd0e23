#include "mesher/generate/mesh_trial.hpp"

#include "mesher/build/mesh_estimate.hpp"
#include "mesher/layers/count_layers.hpp"

namespace quadloop {

MeshTrial::MeshTrial(const MeshInput& input, const MeasuredWall& measured) : input_{input} {
  if (!has_layers(input)) return;
  front_.emplace(front_of(input, measured));
  outer_.emplace(outside(input, *front_));
}

std::int64_t MeshTrial::nodes(const Communicator& comm, const DemandedSplits& demanded) const {
  const MeshResult made = build_mesh(comm, meshed().geometry, meshed().mesh, demanded);
  return made.tree.attributes.nodes + (front_ ? most_layer_nodes(comm, *front_, made.mesh) : 0);
}

MeshEstimate MeshTrial::estimate(const DemandedSplits& demanded) const {
  return estimate_mesh(meshed().geometry, meshed().mesh, demanded);
}

}  // namespace quadloop
