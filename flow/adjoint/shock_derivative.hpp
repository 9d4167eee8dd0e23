#pragma once

#include <vector>

#include "flow/euler/scheme/shock_sensor.hpp"

namespace quadloop::euler {

/// How the shock sensor's shares answer to the states: each to the pressures of its node and of the first
/// neighbour with the largest jump. Shares that are kept answer to nothing.
class ShockDerivative {
 public:
  /// Of the sensor's last call, at these states. The mesh must outlive it. *Collective.*
  ShockDerivative(const Communicator& comm, const DualMesh& mesh, const ShockSensor& sensor,
                  const std::vector<State>& states);

  /// Whether any share answers at all, on any rank.
  bool acts() const { return acts_; }

  /// The changes of shares, of all nodes; those of states must have copies. *Collective.*
  std::vector<double> apply(const std::vector<State>& change) const;

  /// The transpose: adds what weights of the owned nodes' shares make of the states to the owned nodes'
  /// `sums`. *Collective.*
  void add_transposed(const std::vector<double>& weights, std::vector<State>& sums) const;

 private:
  struct Part {
    double by_own = 0, by_neighbour = 0;  ///< pressures
    std::int32_t neighbour = -1;
  };
  const DualMesh& mesh_;
  std::vector<Part> parts_;  ///< of the owned nodes
  bool acts_ = false;
};

}  // namespace quadloop::euler
