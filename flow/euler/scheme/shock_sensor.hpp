#pragma once

#include <algorithm>
#include <vector>

#include "flow/euler/model/gas.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"

namespace quadloop::euler {

/// Of two pressures, over the lower of them or the least that counts.
template <class Real = double>
Real pressure_jump(const Real& a, const Real& b, double least) {
  return (std::max(a, b) - std::min(a, b)) / std::max<Real>(std::min(a, b), least);
}

/// How much the middle wave is to be damped where such a jump is: it rises smoothly from 0 at a jump of 0.7
/// to 1 at 1.2.
template <class Real = double>
Real shock_share(const Real& jump) {
  constexpr double weakest = 0.7, range = 0.5;
  const Real x = (jump - weakest) / range;
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  return x * x * (3 - 2 * x);
}

/// Where strong shocks stand. Roe's flux lets a shock that lies along cells break up (the carbuncle, Quirk
/// 1994): nothing damps what varies along it. At nodes with a strong pressure jump to a neighbour the middle
/// wave of all their edges becomes as fast as sound, so that the flux turns into that of Harten, Lax and van
/// Leer with Einfeldt's speeds (1988), which is free of this; most other edges know nothing of it. Shocks of
/// a normal Mach number below some 1.3, which spread over two or three edges, do not count.
class ShockSensor {
 public:
  /// The mesh must outlive the sensor. Jumps count relative to no less than that pressure.
  ShockSensor(const DualMesh& mesh, double least_pressure);

  /// Looks at the states, whose copies are up to date. *Collective.*
  void find(const std::vector<State>& states);

  /// Of an edge between these nodes.
  double share(std::int32_t a, std::int32_t b) const { return shares_[decider(a, b)]; }
  /// Which of the two has the larger share.
  std::int32_t decider(std::int32_t a, std::int32_t b) const { return shares_[b] > shares_[a] ? b : a; }

  /// From now on the shares stay as they were in the last call.
  void freeze() { frozen_ = true; }
  void release() { frozen_ = false; }
  bool frozen() const { return frozen_; }

  /// What the last call found at an owned node: the largest jump to a neighbour.
  double jump(std::int32_t node) const { return jumps_[node]; }
  double least_pressure() const { return least_pressure_; }

 private:
  const DualMesh& mesh_;
  double least_pressure_;
  std::vector<double> jumps_, shares_;  ///< of each node
  bool frozen_ = false;
};

}  // namespace quadloop::euler
