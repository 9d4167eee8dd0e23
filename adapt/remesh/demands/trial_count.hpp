#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "adapt/remesh/demands/restart.hpp"
#include "generate/mesh_trial.hpp"

namespace quadloop {

/// Counts the nodes that changes of a tree lead to, from trees of their own (MeshTrial).
class TrialCount {
 public:
  /// `input` and the communicator must outlive it. Throws as MeshTrial does.
  TrialCount(const Communicator& comm, const MeshInput& input, const MeasuredWall& measured)
      : comm_{comm}, trial_{input, measured}, limit_{input.mesh.limit} {}

  static constexpr std::int64_t beyond = std::numeric_limits<std::int64_t>::max();

  /// `beyond` where the mesh would not be allowed. *Collective.*
  NodeBounds nodes_after(const ChangedSplits& changes) const;

  /// What the mesh would take of --max-cells or free memory, by an estimate. *Collective.*
  double share_of_limit(const ChangedSplits& changes) const;
  bool allowed(const ChangedSplits& changes) const { return share_of_limit(changes) <= 1; }

  /// Of cap and limit, what is used up of the one that is nearer to it, at least and at most; above 1: too
  /// many.
  struct Share {
    double least = 0, most = 0;
  };
  /// Without a cap estimates do. *Collective.*
  Share filled(const std::optional<std::int64_t>& most, const ChangedSplits& changes) const;

 private:
  NodeBounds nodes_of(const DemandedSplits& demanded) const;

  const Communicator& comm_;
  MeshTrial trial_;
  MeshLimit limit_;
};

}  // namespace quadloop
