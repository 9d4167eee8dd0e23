#pragma once

#include <optional>
#include <vector>

#include "flow/adjoint/limiter_derivative.hpp"
#include "flow/adjoint/shock_derivative.hpp"
#include "flow/euler/model/flux_jacobian.hpp"
#include "flow/euler/scheme/flow_run.hpp"

namespace quadloop::flow::euler {

/// Derivative of the residual of inviscid flow with respect to the states (density, velocity, pressure), for
/// the complete second-order scheme; fluxes are differentiated by the same functions with dual numbers.
/// Limiter and shock sensor are differentiated too, or constant if frozen, as in Residual.
class LinearResidual {
 public:
  /// At the run's states, where the residual is evaluated once more. The objects that the run refers to must
  /// outlive this one. *Collective.*
  explicit LinearResidual(FlowRun& run);

  /// Computes the change of the owned nodes' net fluxes due to changes of the states, which have an entry for
  /// each node; those of ghosts are updated first. *Collective.*
  void apply(IdVector<NodeId, State>& change, IdVector<NodeId, Flux>& sums) const;

  /// Transpose: computes the weights of the owned nodes' states due to weights of net fluxes. *Collective.*
  void apply_transposed(IdVector<NodeId, Flux>& weights, IdVector<NodeId, State>& sums) const;

  /// Returns the weights of the owned nodes' limited gradients due to weights of net fluxes, which must
  /// include ghosts.
  IdVector<NodeId, Gradient> limited_gradient_weights(const IdVector<NodeId, Flux>& weights) const;
  /// Empty if the scheme has no limiter.
  const std::optional<LimiterDerivative>& limiter() const { return limiter_; }
  const FlowRun& run() const { return run_; }

 private:
  /// Derivatives of the flux through an edge's face.
  struct EdgePart {
    Matrix4 by_left, by_right;
    bool reconstructed;
  };
  /// Derivatives of its skewness correction with respect to the means of its nodes' states and gradients.
  struct SkewPart {
    Matrix4 by_state, by_x, by_y;
  };
  /// Derivative of the flux through an edge's face with respect to the shock sensor's share at one of its
  /// nodes.
  struct ShockPart {
    std::size_t edge;
    NodeId node;
    Flux by_share;
  };
  void differentiate_edges();
  void differentiate_skew();
  void differentiate_faces();
  void apply_edges(const IdVector<NodeId, State>& change, const IdVector<NodeId, Gradient>& gradients,
                   IdVector<NodeId, Flux>& sums) const;
  void apply_shocks(const IdVector<NodeId, State>& change, IdVector<NodeId, Flux>& sums) const;
  void apply_faces(const IdVector<NodeId, State>& change, IdVector<NodeId, Flux>& sums) const;
  void transpose_edges(const IdVector<NodeId, Flux>& weights, IdVector<NodeId, State>& sums,
                       IdVector<NodeId, Gradient>& gradients) const;
  void transpose_shocks(const IdVector<NodeId, Flux>& weights, IdVector<NodeId, State>& sums) const;
  void transpose_faces(const IdVector<NodeId, Flux>& weights, IdVector<NodeId, State>& sums) const;

  const FlowRun& run_;
  std::optional<LimiterDerivative> limiter_;
  std::vector<EdgePart> edges_;
  std::vector<SkewPart> skew_;
  std::optional<ShockDerivative> shocks_;  ///< if it depends on the states
  std::vector<ShockPart> shock_edges_;
  std::vector<std::array<Matrix4, 2>> faces_;  ///< of the halves at both nodes
};

}  // namespace quadloop::flow::euler
