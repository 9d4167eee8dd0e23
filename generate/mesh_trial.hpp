#pragma once

#include <cstdint>
#include <optional>

#include "generate/outside_layers.hpp"
#include "mesher/layers/count_layers.hpp"

namespace quadloop {

/// What meshes of one input would come to for different demands, without making the whole of them.
class MeshTrial {
 public:
  /// `input` must outlive it. Throws InputError where its layers do not fit.
  explicit MeshTrial(const MeshInput& input, const MeasuredWall& measured = {});
  MeshTrial(const MeshTrial&) = delete;
  MeshTrial& operator=(const MeshTrial&) = delete;

  /// The nodes that generate_mesh() would make: counted on the leaves (count_nodes()); with layers on the
  /// mesh outside them, which is not smoothed, with the nodes of the layers. The bounds differ at sharp edges
  /// alone (layer_nodes()). Throws as these do. *Collective.*
  NodeBounds nodes(const Communicator& comm, const DemandedSplits& demanded) const;

  /// The same on any number of ranks; not collective.
  MeshEstimate estimate(const DemandedSplits& demanded) const;

 private:
  const MeshInput& meshed() const { return outer_ ? *outer_ : input_; }

  const MeshInput& input_;
  std::optional<Geometry> geometry_;
  std::optional<LayerFront> front_;
  std::optional<MeshInput> outer_;
};

}  // namespace quadloop
