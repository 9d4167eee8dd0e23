#pragma once

#include <algorithm>

#include "flow/euler/model/gas.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"

namespace quadloop::flow::euler {

/// Returns the jump of two pressures relative to the lower one, or to `least` if that is larger.
template <class Real = double>
Real pressure_jump(const Real& a, const Real& b, double least) {
  return (std::max(a, b) - std::min(a, b)) / std::max<Real>(std::min(a, b), least);
}

/// Returns the additional damping of the middle wave at such a jump: rises smoothly from 0 at 0.7 to 1 at
/// 1.2.
template <class Real = double>
Real shock_share(const Real& jump) {
  constexpr double weakest = 0.7, range = 0.5;
  const Real x = (jump - weakest) / range;
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  return x * x * (3 - 2 * x);
}

/// Detects strong shocks. Roe's flux lets a shock aligned with cells break up (the carbuncle, Quirk 1994), as
/// nothing damps variations along it. At nodes with a strong pressure jump to a neighbour the middle wave of
/// all edges is made as fast as sound, which gives the flux of Harten, Lax and van Leer with Einfeldt's
/// speeds (1988), which is free of the carbuncle; most other edges are unaffected. Shocks of a normal Mach
/// number below about 1.3, which spread over two or three edges, do not count.
class ShockSensor {
 public:
  /// The mesh must outlive the sensor. Jumps are relative to at least `least_pressure`.
  ShockSensor(const DualMesh& mesh, double least_pressure);

  /// Evaluates the states; ghosts must be up to date. *Collective.*
  void find(const IdVector<NodeId, State>& states);

  /// Damping of the edge between these nodes.
  double share(NodeId a, NodeId b) const { return shares_[decider(a, b)]; }
  /// Returns the node with the larger share.
  NodeId decider(NodeId a, NodeId b) const { return shares_[b] > shares_[a] ? b : a; }

  /// Freezes the shares of the last call.
  void freeze() { frozen_ = true; }
  void release() { frozen_ = false; }
  bool frozen() const { return frozen_; }

  /// Largest jump to a neighbour of an owned node, from the last call.
  double jump(NodeId node) const { return jumps_[node]; }
  double least_pressure() const { return least_pressure_; }

 private:
  const DualMesh& mesh_;
  double least_pressure_;
  IdVector<NodeId, double> jumps_, shares_;  ///< for each node
  bool frozen_ = false;
};

}  // namespace quadloop::flow::euler
