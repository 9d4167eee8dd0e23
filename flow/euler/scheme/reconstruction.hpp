#pragma once

#include <algorithm>
#include <type_traits>

#include "flow/euler/model/gas.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"

namespace quadloop::flow::euler {

/// Gradient of each variable along x and along y.
struct Gradient {
  std::array<double, 4> x{}, y{};
};

/// The gradient after a rotation: its own direction turns, and the velocity.
inline Gradient turned(const Gradient& gradient, Point direction) {
  Gradient result{turned(gradient.x, direction), turned(gradient.y, direction)};
  for (std::size_t k = 0; k < 4; ++k) {
    const Point v = turned(Point{result.x[k], result.y[k]}, direction);
    result.x[k] = v.x;
    result.y[k] = v.y;
  }
  return result;
}

/// Nodal gradients by least squares over the edges, weighted by the inverse edge length: exact for linear
/// fields on any mesh.
class LeastSquares {
 public:
  explicit LeastSquares(const DualMesh& mesh);

  /// Computes the gradients of the owned nodes; `gradients` has an entry for each node. The states of ghosts
  /// must be up to date.
  void compute(const IdVector<NodeId, State>& states, IdVector<NodeId, Gradient>& gradients) const;

  /// Transpose of compute(): adds to the owned nodes' `sums` the weights of the states due to `weights` of
  /// the gradients. `weights` has an entry for each node; only those of owned nodes are used. *Collective.*
  void add_transposed(const IdVector<NodeId, Gradient>& weights, IdVector<NodeId, State>& sums) const;
  /// Returns the inverse normal matrices times such weights, for all nodes. *Collective.*
  IdVector<NodeId, Gradient> solved(const IdVector<NodeId, Gradient>& weights) const;

 private:
  struct Symmetric {
    double xx = 0, xy = 0, yy = 0;
  };

  const DualMesh& mesh_;
  IdVector<NodeId, Symmetric> inverse_;  ///< inverse of each owned node's normal matrix
};

/// Returns the factor that limits a change to the allowed value, both positive.
template <class Real = double>
Real limiting_factor(const Real& allowed, const Real& change,
                     const std::type_identity_t<Real>& small_squared) {
  if (2 * change <= allowed) return 1;
  const Real square = allowed * allowed + small_squared;
  return std::min<Real>(1.0,
                        (square + 2 * change * allowed) / (square + 2 * change * change + allowed * change));
}

/// Returns the factor that limits a change of density or pressure such that a fifth of the value remains;
/// `change` is negative for a decrease.
template <class Real = double>
Real keeping_factor(const Real& value, const Real& change) {
  constexpr double largest_loss = 0.8;
  const Real room = largest_loss * std::max<Real>(value, 0);
  return -change > room ? -room / change : Real(1);
}

/// Whether this variable of a state must be positive.
constexpr bool is_positive(std::size_t variable) { return variable == 0 || variable == 3; }

/// Venkatakrishnan's limiter (1995): scales each variable's gradient at a node such that the values at the
/// midpoints of its edges stay within the range of the node and its neighbours. It is smooth and inactive
/// where the flow varies by less than (K h)^1.5, with K = 5 and h the square root of the dual cell's area in
/// units of the reference length. So smooth flow is not limited once the mesh resolves it. In addition,
/// density and pressure keep a fifth of the node's value: edges that switch to first order where little is
/// left, e.g. behind a bluff body, would oscillate forever.
class Limiter {
 public:
  Limiter(const DualMesh& mesh, double reference_length);

  /// Scales the owned nodes' gradients. The states of ghosts must be up to date.
  void apply(const IdVector<NodeId, State>& states, IdVector<NodeId, Gradient>& gradients);

  /// Freezes the factors of the last call.
  void freeze() { frozen_ = true; }
  void release() { frozen_ = false; }
  bool frozen() const { return frozen_; }

  /// Range of each variable over a node and its neighbours.
  struct Bounds {
    std::array<double, 4> low, high;
  };
  /// Data of the last call at the owned nodes: the factors and the values they depend on (with frozen
  /// factors, those of the call that computed them).
  const IdVector<NodeId, std::array<double, 4>>& factors() const { return factors_; }
  const Bounds& values(NodeId node) const { return values_[node]; }
  const Bounds& changes(NodeId node) const { return changes_[node]; }
  double small_squared(NodeId node) const { return small_squared_[node]; }

 private:
  void find_bounds(const IdVector<NodeId, State>& states);
  void find_changes(const IdVector<NodeId, Gradient>& gradients);
  void find_factors(const IdVector<NodeId, State>& states);

  const DualMesh& mesh_;
  IdVector<NodeId, double> small_squared_;  ///< (K h)^3 of each owned node
  IdVector<NodeId, Bounds> values_;         ///< of the states
  IdVector<NodeId, Bounds> changes_;        ///< of the increments by the gradients at the midpoints of edges
  IdVector<NodeId, std::array<double, 4>> factors_;
  bool frozen_ = false;
};

}  // namespace quadloop::flow::euler
