#include "generate/mesh_trial.hpp"

#include "mesher/build/count_nodes.hpp"
#include "mesher/build/mesh_estimate.hpp"

namespace quadloop {

MeshTrial::MeshTrial(const MeshInput& input, const MeasuredWall& measured) : input_{input} {
  if (!has_layers(input)) return;
  MeshReport dropped;  // reported when the mesh is made
  geometry_.emplace(geometry_with_layers(input, dropped));
  front_.emplace(front_of(input, *geometry_, measured));
  outer_.emplace(outside(input, *front_));
}

NodeBounds MeshTrial::nodes(const Communicator& comm, const DemandedSplits& demanded) const {
  if (!front_) {
    const std::int64_t nodes = count_nodes(comm, meshed().geometry, meshed().mesh, demanded);
    return {nodes, nodes};
  }
  const MeshResult made = build_mesh(comm, meshed().geometry, meshed().mesh, demanded);
  const std::int64_t outer = made.tree.attributes.nodes;
  const NodeBounds layers = layer_nodes(comm, *front_, made.mesh);
  return {outer + layers.least, outer + layers.most};
}

MeshEstimate MeshTrial::estimate(const DemandedSplits& demanded) const {
  return estimate_mesh(meshed().geometry, meshed().mesh, demanded);
}

}  // namespace quadloop
