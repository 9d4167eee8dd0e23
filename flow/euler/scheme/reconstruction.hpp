#pragma once

#include <algorithm>
#include <type_traits>
#include <vector>

#include "flow/euler/model/gas.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"

namespace quadloop::euler {

/// The change of each variable along x and along y.
struct Gradient {
  std::array<double, 4> x{}, y{};
};

/// Gradients at nodes by least squares over their edges, weighted by the inverse of the edge's length: exact
/// for linear fields on any mesh.
class LeastSquares {
 public:
  explicit LeastSquares(const DualMesh& mesh);

  /// Of the owned nodes; `gradients` has an entry for each node. The states' copies must be up to date.
  void compute(const std::vector<State>& states, std::vector<Gradient>& gradients) const;

  /// The transpose of that: adds to the owned nodes' `sums` what `weights` of gradients make of the states.
  /// `weights` has an entry for each node, of which those of owned nodes count. *Collective.*
  void add_transposed(const std::vector<Gradient>& weights, std::vector<State>& sums) const;
  /// The normal matrices' inverses times such weights, of all nodes. *Collective.*
  std::vector<Gradient> solved(const std::vector<Gradient>& weights) const;

 private:
  struct Symmetric {
    double xx = 0, xy = 0, yy = 0;
  };

  const DualMesh& mesh_;
  std::vector<Symmetric> inverse_;  ///< of each owned node's normal matrix
};

/// The factor by which a change must be made smaller so as to stay under what is allowed, both above zero.
template <class Real = double>
Real limiting_factor(const Real& allowed, const Real& change,
                     const std::type_identity_t<Real>& small_squared) {
  if (2 * change <= allowed) return 1;
  const Real square = allowed * allowed + small_squared;
  return std::min<Real>(1.0,
                        (square + 2 * change * allowed) / (square + 2 * change * change + allowed * change));
}

/// The factor by which a change must be made smaller so that a density or pressure that falls by it keeps a
/// fifth; `change` is below zero where it falls.
template <class Real = double>
Real keeping_factor(const Real& value, const Real& change) {
  constexpr double largest_loss = 0.8;
  const Real room = largest_loss * std::max<Real>(value, 0);
  return -change > room ? -room / change : Real(1);
}

/// Whether that variable of a state must stay above zero.
constexpr bool is_positive(std::size_t variable) { return variable == 0 || variable == 3; }

/// Venkatakrishnan's limiter (1995): each variable's gradient at a node is scaled so that the values at the
/// middles of its edges stay within those of the node and its neighbours, smoothly, and not at all where the
/// flow varies by less than (K h)^1.5. There h is the side of the square of the dual cell's area in units of
/// the reference length, and K = 5. So smooth flow is not limited once the mesh resolves it. Density and
/// pressure keep a fifth of the node's own besides: edges that switched to first order where little is left,
/// as behind a bluff body, would go to and fro for good.
class Limiter {
 public:
  Limiter(const DualMesh& mesh, double reference_length);

  /// Scales the owned nodes' gradients. The states' copies must be up to date.
  void apply(const std::vector<State>& states, std::vector<Gradient>& gradients);

  /// From now on the factors stay as they were in the last call.
  void freeze() { frozen_ = true; }
  void release() { frozen_ = false; }
  bool frozen() const { return frozen_; }

  /// Of each variable, over a node and its neighbours.
  struct Bounds {
    std::array<double, 4> low, high;
  };
  /// What the last call found at the owned nodes: the factors, and what they were made from, which is not
  /// that call's where they are frozen.
  const std::vector<std::array<double, 4>>& factors() const { return factors_; }
  const Bounds& values(std::size_t node) const { return values_[node]; }
  const Bounds& changes(std::size_t node) const { return changes_[node]; }
  double small_squared(std::size_t node) const { return small_squared_[node]; }

 private:
  void find_bounds(const std::vector<State>& states);
  void find_changes(const std::vector<Gradient>& gradients);
  void find_factors(const std::vector<State>& states);

  const DualMesh& mesh_;
  std::vector<double> small_squared_;  ///< of each owned node: (K h)^3
  std::vector<Bounds> values_;         ///< of the states
  std::vector<Bounds> changes_;        ///< of what the gradients add at the middles of edges
  std::vector<std::array<double, 4>> factors_;
  bool frozen_ = false;
};

}  // namespace quadloop::euler
