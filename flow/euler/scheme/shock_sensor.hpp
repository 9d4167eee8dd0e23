#pragma once

#include <vector>

#include "flow/euler/scheme/dual_mesh.hpp"
#include "flow/euler/scheme/gas.hpp"

namespace quadloop::euler {

/// Where strong shocks stand. Roe's flux lets a shock along cells break up (the carbuncle, Quirk 1994), as
/// nothing damps what varies along it; edges of a node with a strong pressure jump beside it get a middle
/// wave of a least speed, as in the H-correction of Sanders, Morano and Druguet (1998). Shocks of a normal
/// Mach number below some 1.3 count for nothing.
class ShockSensor {
 public:
  /// The mesh must outlive the sensor. Jumps count relative to no less than that pressure.
  ShockSensor(const DualMesh& mesh, double least_pressure);

  /// Looks at the states, whose copies are up to date. *Collective.*
  void find(const std::vector<State>& states);

  /// The least speed of the edge's middle wave, as a share of its largest wave speed.
  double least_middle(const DualEdge& edge) const;

  /// From now on it stays as it was in the last call.
  void freeze() { frozen_ = true; }
  void release() { frozen_ = false; }

 private:
  const DualMesh& mesh_;
  double least_pressure_;
  std::vector<double>
      jumps_;  ///< of each node: the largest to a neighbour, over the lower of the two pressures
  std::vector<double> shares_;  ///< of each node
  bool frozen_ = false;
};

}  // namespace quadloop::euler
