#pragma once

#include <cstdint>
#include <optional>

#include "generate/outside_layers.hpp"
#include "mesher/layers/count_layers.hpp"

namespace quadloop {

/// Predicts the size of meshes of one input for different demands, without generating them completely.
class MeshTrial {
 public:
  /// `comm` and `input` must outlive the object. Throws InputError if its layers do not fit. *Collective.*
  MeshTrial(const Communicator& comm, const MeshInput& input, const MeasuredFlow& measured = {});
  MeshTrial(const MeshTrial&) = delete;
  MeshTrial& operator=(const MeshTrial&) = delete;

  /// Returns the number of nodes of the mesh of generate_mesh(): counted on the quadtree cells
  /// (count_nodes()); with layers, counted on the unsmoothed mesh outside them plus the nodes of the layers.
  /// The bounds differ only at sharp edges (layer_nodes()). Throws as these do. *Collective.*
  NodeBounds nodes(const DemandedSplits& demanded) const;

  /// Returns an estimate, the same on any number of ranks. Not collective.
  MeshEstimate estimate(const DemandedSplits& demanded) const;

 private:
  /// The outer edge of the layers, and the domain outside it.
  struct Layered {
    LayerFront front;
    MeshInput outer;
  };
  Layered layered(const DemandedSplits& demanded) const;

  const Communicator& comm_;
  std::optional<MeshInput> sized_;  ///< with the sizes that wakes without layers request
  const MeshInput& input_;
  MeasuredFlow measured_;
  std::optional<Geometry> geometry_;
  std::optional<Layered> of_case_;  ///< without demands
};

}  // namespace quadloop
