#pragma once

#include "flow/euler/scheme/shock_sensor.hpp"

namespace quadloop::flow::euler {

/// Derivative of the shock sensor's shares with respect to the states: each depends on the pressures of its
/// node and of the first neighbour with the largest jump. Frozen shares have zero derivative.
class ShockDerivative {
 public:
  /// For the sensor's last call, at these states. The mesh must outlive the object. *Collective.*
  ShockDerivative(const Communicator& comm, const DualMesh& mesh, const ShockSensor& sensor,
                  const IdVector<NodeId, State>& states);

  /// Whether any share has a non-zero derivative, on any rank.
  bool acts() const { return acts_; }

  /// Returns the changes of the shares of all nodes; those of the states must include ghosts. *Collective.*
  IdVector<NodeId, double> apply(const IdVector<NodeId, State>& change) const;

  /// Transpose: adds the weights of the states due to weights of the owned nodes' shares to the owned nodes'
  /// `sums`. *Collective.*
  void add_transposed(const IdVector<NodeId, double>& weights, IdVector<NodeId, State>& sums) const;

 private:
  struct Part {
    double by_own = 0, by_neighbour = 0;  ///< with respect to the pressures
    NodeId neighbour;
  };
  const DualMesh& mesh_;
  IdVector<NodeId, Part> parts_;  ///< of the owned nodes
  bool acts_ = false;
};

}  // namespace quadloop::flow::euler
