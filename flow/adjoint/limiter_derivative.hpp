#pragma once

#include <array>

#include "flow/euler/scheme/reconstruction.hpp"

namespace quadloop::flow::euler {

/// Derivative of the limited gradients with respect to states and gradients. A factor that depends on the
/// extreme value, or change, among a node's edges is differentiated for the first such edge only. Frozen
/// factors have zero derivative.
class LimiterDerivative {
 public:
  /// For the limiter's last call, at these states and these unlimited gradients. The mesh must outlive the
  /// object.
  LimiterDerivative(const DualMesh& mesh, const Limiter& limiter, const IdVector<NodeId, State>& states,
                    IdVector<NodeId, Gradient> gradients);

  /// Converts the owned nodes' changes of gradients to changes of limited gradients. The changes of states
  /// must include ghosts.
  void apply(const IdVector<NodeId, State>& change, IdVector<NodeId, Gradient>& gradients) const;

  /// Transpose: converts weights of the owned nodes' limited gradients to weights of gradients, and adds the
  /// weights of states to the owned nodes' `sums`. *Collective.*
  void apply_transposed(IdVector<NodeId, Gradient>& weights, IdVector<NodeId, State>& sums) const;

  /// Adds to the owned nodes' sums the weights, due to weights of limited gradients, of node positions and of
  /// dual areas, on which the factors depend. *Collective.*
  void add_place_weights(const IdVector<NodeId, Gradient>& weights, IdVector<NodeId, Point>& places,
                         IdVector<NodeId, double>& areas) const;

 private:
  /// For one variable at one node.
  struct Part {
    double factor = 1;
    double by_allowed = 0, by_change = 0;  ///< derivatives, with the sign of the deciding side
    double by_small = 0;                   ///< with respect to small_squared
    double by_own = 0;  ///< with respect to the node's own value, part of which must remain
    NodeId neighbour;   ///< neighbour with the deciding value
    NodeId along;       ///< neighbour along the edge with the deciding change
    Point way;          ///< to that edge's midpoint
  };
  struct Side;
  void find(const Limiter& limiter, const IdVector<NodeId, State>& states);
  void follow_bounds(const Limiter& limiter, NodeId node, std::size_t k, double value, const Side& up,
                     const Side& down);
  void follow_keeping(const Limiter& limiter, NodeId node, std::size_t k, double value, const Side& down);
  void find_edges(const Limiter& limiter, const IdVector<NodeId, State>& states,
                  IdVector<NodeId, std::array<Side, 2>>& sides) const;

  const DualMesh& mesh_;
  IdVector<NodeId, Gradient> gradients_;
  IdVector<NodeId, std::array<Part, 4>> parts_;  ///< of the owned nodes
  IdVector<NodeId, double> small_squared_;       ///< of the owned nodes
  bool live_;
};

}  // namespace quadloop::flow::euler
