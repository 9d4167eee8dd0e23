#pragma once

#include <cstdint>

#include "flow/euler/implicit/implicit_system.hpp"

namespace quadloop::flow::euler {

/// Share of the CFL number for each node. The first-order matrix of an implicit step may be too weak by more
/// than a half for the second-order fluxes at a single node, e.g. where cell sizes change abruptly: its
/// changes then oscillate and grow, at large CFL numbers only. If changes reverse repeatedly, the node's
/// share is halved until they no longer do; it grows again slowly.
class StepFractions {
 public:
  explicit StepFractions(std::size_t owned_nodes);

  /// Updates the shares with the owned nodes' changes of one more step.
  void follow(const IdVector<NodeId, Change>& change);

  /// Forgets previous changes: the flow was reset.
  void forget();

  /// Restarts completely: the residual has changed.
  void restart();

  const IdVector<NodeId, double>& shares() const { return shares_; }  ///< for each owned node

 private:
  IdVector<NodeId, double> shares_;
  IdVector<NodeId, Change> last_;
  IdVector<NodeId, std::int8_t> turns_;  ///< number of consecutive reversals of the node's change
};

}  // namespace quadloop::flow::euler
