#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "adapt/remesh/demands/restart.hpp"
#include "generate/mesh_trial.hpp"

namespace quadloop::adapt {

/// Predicts the number of nodes after changes of a tree (MeshTrial).
class TrialCount {
 public:
  /// `input` and the communicator must outlive the object. Throws as MeshTrial does.
  TrialCount(const Communicator& comm, const MeshInput& input, const MeasuredFlow& measured)
      : comm_{comm}, trial_{comm, input, measured}, limit_{input.mesh.limit} {}

  static constexpr std::int64_t beyond = std::numeric_limits<std::int64_t>::max();

  /// Returns bounds on the number of nodes; `beyond` if the mesh would exceed the limit. *Collective.*
  NodeBounds nodes_after(const ChangedSplits& changes) const;

  /// Returns the estimated fraction of --max-cells or free memory that the mesh would use. *Collective.*
  double share_of_limit(const ChangedSplits& changes) const;
  bool allowed(const ChangedSplits& changes) const { return share_of_limit(changes) <= 1; }

  /// Bounds on the used fraction of the node cap or the mesh limit, whichever is closer to being reached;
  /// above 1: exceeded.
  struct Share {
    double least = 0, most = 0;
  };
  /// Returns the fraction; without a cap an estimate suffices. *Collective.*
  Share filled(const std::optional<std::int64_t>& most, const ChangedSplits& changes) const;

 private:
  NodeBounds nodes_of(const DemandedSplits& demanded) const;

  const Communicator& comm_;
  MeshTrial trial_;
  MeshLimit limit_;
};

}  // namespace quadloop::adapt
