#pragma once

#include <cstdint>
#include <vector>

#include "flow/euler/model/flow_model.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"

namespace quadloop::euler {

/// The nodes on walls to which a viscous flow sticks. What they conserve is partly known: no momentum, and at
/// a wall of given temperature an energy that the density alone decides; the rows of these in an implicit
/// step say so.
class NoSlipNodes {
 public:
  NoSlipNodes(const DualMesh& mesh, const FlowModel& model);

  bool empty() const { return nodes_.empty(); }

  /// Brings the states to rest, and to the wall's temperature.
  void hold(std::vector<State>& states) const;

  /// Takes the momentum out of the owned nodes' net fluxes: what is left of it is the wall's friction, the
  /// force per depth on the fluid. At walls of given temperature the energy too.
  void take_friction(std::vector<Flux>& sums, std::vector<Point>& friction) const;

  /// Of each of so many nodes the last of the rows, from 1 on, that say what is known; 0 where none does.
  std::vector<char> held_rows(std::size_t nodes) const;

  /// Writes these rows into the owned nodes' diagonal blocks; in other blocks they are 0.
  void hold(std::vector<Matrix4>& diagonal) const;

 private:
  struct Node {
    std::int32_t node;
    double energy;  ///< per mass at rest, of the wall's temperature; 0: adiabatic
  };
  double gamma_;
  std::vector<Node> nodes_;  ///< owned, ascending
};

}  // namespace quadloop::euler
