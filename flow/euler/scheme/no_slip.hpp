#pragma once

#include <vector>

#include "flow/euler/model/flow_model.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"

namespace quadloop::flow::euler {

/// The nodes on no-slip walls. Their conserved variables are partly prescribed: zero momentum and, at an
/// isothermal wall, an energy that depends on the density alone. The corresponding rows of an implicit step
/// express this.
class NoSlipNodes {
 public:
  NoSlipNodes(const DualMesh& mesh, const FlowModel& model);

  bool empty() const { return nodes_.empty(); }

  /// Sets the velocity to 0, and the temperature of isothermal walls.
  void hold(IdVector<NodeId, State>& states) const;

  /// Moves the momentum of the owned nodes' net fluxes to `friction`: the wall friction, as force per unit
  /// depth on the fluid. At isothermal walls the energy flux is removed too.
  void take_friction(IdVector<NodeId, Flux>& sums, IdVector<NodeId, Point>& friction) const;

  /// Returns for each of `nodes` nodes the last prescribed row, counted from 1; 0 if there is none.
  IdVector<NodeId, char> held_rows(std::size_t nodes) const;

  /// Writes the prescribed rows to the owned nodes' diagonal blocks; in other blocks they are 0.
  void hold(IdVector<NodeId, Matrix4>& diagonal) const;

 private:
  struct Node {
    NodeId node;
    double energy;  ///< per unit mass at rest, at the wall temperature; 0: adiabatic
  };
  double gamma_;
  std::vector<Node> nodes_;  ///< owned nodes, ascending
};

}  // namespace quadloop::flow::euler
