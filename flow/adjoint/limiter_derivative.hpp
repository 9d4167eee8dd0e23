#pragma once

#include <array>
#include <vector>

#include "flow/euler/scheme/reconstruction.hpp"

namespace quadloop::flow::euler {

/// Derivative of the limited gradients with respect to states and gradients. A factor that depends on the
/// extreme value, or change, among a node's edges is differentiated for the first such edge only. Frozen
/// factors have zero derivative.
class LimiterDerivative {
 public:
  /// For the limiter's last call, at these states and these unlimited gradients. The mesh must outlive the
  /// object.
  LimiterDerivative(const DualMesh& mesh, const Limiter& limiter, const std::vector<State>& states,
                    std::vector<Gradient> gradients);

  /// Converts the owned nodes' changes of gradients to changes of limited gradients. The changes of states
  /// must include ghosts.
  void apply(const std::vector<State>& change, std::vector<Gradient>& gradients) const;

  /// Transpose: converts weights of the owned nodes' limited gradients to weights of gradients, and adds the
  /// weights of states to the owned nodes' `sums`. *Collective.*
  void apply_transposed(std::vector<Gradient>& weights, std::vector<State>& sums) const;

  /// Adds to the owned nodes' sums the weights, due to weights of limited gradients, of node positions and of
  /// dual areas, on which the factors depend. *Collective.*
  void add_place_weights(const std::vector<Gradient>& weights, std::vector<Point>& places,
                         std::vector<double>& areas) const;

 private:
  /// For one variable at one node.
  struct Part {
    double factor = 1;
    double by_allowed = 0, by_change = 0;  ///< derivatives, with the sign of the deciding side
    double by_small = 0;                   ///< with respect to small_squared
    double by_own = 0;            ///< with respect to the node's own value, part of which must remain
    std::int32_t neighbour = -1;  ///< neighbour with the deciding value
    std::int32_t along = -1;      ///< neighbour along the edge with the deciding change
    Point way;                    ///< to that edge's midpoint
  };
  struct Side;
  void find(const Limiter& limiter, const std::vector<State>& states);
  void follow_bounds(const Limiter& limiter, std::size_t node, std::size_t k, double value, const Side& up,
                     const Side& down);
  void follow_keeping(const Limiter& limiter, std::size_t node, std::size_t k, double value,
                      const Side& down);
  void find_edges(const Limiter& limiter, const std::vector<State>& states, std::vector<Side>& sides) const;

  const DualMesh& mesh_;
  std::vector<Gradient> gradients_;
  std::vector<std::array<Part, 4>> parts_;  ///< of the owned nodes
  std::vector<double> small_squared_;       ///< of the owned nodes
  bool live_;
};

}  // namespace quadloop::flow::euler
