#pragma once

#include <optional>
#include <vector>

#include "flow/adjoint/limiter_derivative.hpp"
#include "flow/adjoint/shock_derivative.hpp"
#include "flow/euler/model/flux_jacobian.hpp"
#include "flow/euler/scheme/flow_run.hpp"

namespace quadloop::euler {

/// The derivative of the residual by the states (density, velocity, pressure) of a flow without viscosity: of
/// the whole second-order scheme, its fluxes' by the same functions in dual numbers. The limiter and the
/// shock sensor are differentiated too, or are constants where their factors are kept, as Residual has it.
class LinearResidual {
 public:
  /// At the run's states, where the residual is evaluated once more. What the run refers to must outlive it.
  /// *Collective.*
  explicit LinearResidual(FlowRun& run);

  /// How the owned nodes' net fluxes answer to changes of the states, an entry for each node; those of copies
  /// are brought up to date first. *Collective.*
  void apply(std::vector<State>& change, std::vector<Flux>& sums) const;

  /// The transpose: what weights of net fluxes make of the owned nodes' states. *Collective.*
  void apply_transposed(std::vector<Flux>& weights, std::vector<State>& sums) const;

  /// The same weights' limited gradients, of the owned nodes: the part of what acts through them. The weights
  /// must have copies.
  std::vector<Gradient> limited_gradient_weights(const std::vector<Flux>& weights) const;
  /// None where the scheme has no limiter.
  const std::optional<LimiterDerivative>& limiter() const { return limiter_; }
  const FlowRun& run() const { return run_; }

 private:
  /// Of the flux through an edge's face.
  struct EdgePart {
    Matrix4 by_left, by_right;
    bool reconstructed;
  };
  /// Of what is added to it, by the means of its nodes' states and gradients.
  struct SkewPart {
    Matrix4 by_state, by_x, by_y;
  };
  /// Of the flux through an edge's face by the shock sensor's share at one of its nodes.
  struct ShockPart {
    std::size_t edge;
    std::int32_t node;
    Flux by_share;
  };
  void differentiate_edges();
  void differentiate_skew();
  void differentiate_faces();
  void apply_edges(const std::vector<State>& change, const std::vector<Gradient>& gradients,
                   std::vector<Flux>& sums) const;
  void apply_shocks(const std::vector<State>& change, std::vector<Flux>& sums) const;
  void apply_faces(const std::vector<State>& change, std::vector<Flux>& sums) const;
  void transpose_edges(const std::vector<Flux>& weights, std::vector<State>& sums,
                       std::vector<Gradient>& gradients) const;
  void transpose_shocks(const std::vector<Flux>& weights, std::vector<State>& sums) const;
  void transpose_faces(const std::vector<Flux>& weights, std::vector<State>& sums) const;

  const FlowRun& run_;
  std::optional<LimiterDerivative> limiter_;
  std::vector<EdgePart> edges_;
  std::vector<SkewPart> skew_;
  std::optional<ShockDerivative> shocks_;  ///< where it answers to the states
  std::vector<ShockPart> shock_edges_;
  std::vector<std::array<Matrix4, 2>> faces_;  ///< of the halves at both nodes
};

}  // namespace quadloop::euler
