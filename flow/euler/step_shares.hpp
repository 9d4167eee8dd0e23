#pragma once

#include <cstdint>
#include <vector>

#include "flow/euler/implicit/implicit_system.hpp"

namespace quadloop::euler {

/// Which share of the CFL number each node's step has. The first-order matrix of an implicit step may be too
/// weak by more than a half for what a single node's second-order fluxes answer, as where sizes change
/// abruptly: its changes then swing to and fro and grow, at large CFL numbers alone. Where changes turn back
/// again and again, the node's share is halved, until they no longer do; it grows again slowly.
class StepShares {
 public:
  explicit StepShares(std::size_t owned_nodes);

  /// Looks at the owned nodes' changes of one more step.
  void follow(const std::vector<Change>& change);

  /// The changes before count no longer: the flow was set back.
  void forget();

  /// All is learnt anew: the residual is another one.
  void restart();

  const std::vector<double>& shares() const { return shares_; }  ///< of each owned node

 private:
  std::vector<double> shares_;
  std::vector<Change> last_;
  std::vector<std::int8_t> turns_;  ///< how often in a row the node's change went back on the one before
};

}  // namespace quadloop::euler
