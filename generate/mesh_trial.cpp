#include "generate/mesh_trial.hpp"

#include <utility>

#include "generate/sizes_of_wakes.hpp"
#include "mesher/build/count_nodes.hpp"
#include "mesher/build/mesh_estimate.hpp"

namespace quadloop {

MeshTrial::MeshTrial(const Communicator& comm, const MeshInput& input, const MeasuredFlow& measured)
    : comm_{comm},
      sized_{with_sizes_of_wakes(input, measured)},
      input_{sized_ ? *sized_ : input},
      measured_{measured} {
  if (!has_layers(input)) return;
  MeshReport dropped;  // reported when the mesh is made
  geometry_.emplace(geometry_with_layers(input_, dropped));
  of_case_.emplace(layered({}));
}

MeshTrial::Layered MeshTrial::layered(const DemandedSplits& demanded) const {
  LayerFront front = front_of(comm_, input_, *geometry_, measured_, demanded);
  MeshInput outer = outside(input_, front);
  return {std::move(front), std::move(outer)};
}

NodeBounds MeshTrial::nodes(const DemandedSplits& demanded) const {
  if (!of_case_) {
    const std::int64_t nodes = count_nodes(comm_, input_.geometry, input_.mesh, demanded);
    return {nodes, nodes};
  }
  std::optional<Layered> followed;  // layers and the columns of lines follow the demands
  if (!demanded.empty()) followed.emplace(layered(demanded));
  const Layered& used = followed ? *followed : *of_case_;
  const MeshResult made = build_mesh(comm_, used.outer.geometry, used.outer.mesh, demanded);
  const std::int64_t outer = made.tree.attributes.nodes;
  const NodeBounds layers = layer_nodes(comm_, used.front, made.mesh);
  return {outer + layers.least, outer + layers.most};
}

MeshEstimate MeshTrial::estimate(const DemandedSplits& demanded) const {
  const MeshInput& meshed = of_case_ ? of_case_->outer : input_;
  return estimate_mesh(meshed.geometry, meshed.mesh, demanded);
}

}  // namespace quadloop
