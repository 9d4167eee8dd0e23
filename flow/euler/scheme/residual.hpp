#pragma once

#include <optional>

#include "flow/euler/model/flow_model.hpp"
#include "flow/euler/model/flux.hpp"
#include "flow/euler/scheme/dual_mesh.hpp"
#include "flow/euler/scheme/far_field.hpp"
#include "flow/euler/scheme/no_slip.hpp"
#include "flow/euler/scheme/reconstruction.hpp"
#include "flow/euler/scheme/shock_sensor.hpp"
#include "flow/euler/scheme/viscous.hpp"

namespace quadloop::flow::euler {

/// The net flux out of each owned node's dual cell: second order, with Roe fluxes between states at the
/// midpoints of edges from limited gradients; in viscous flow minus the viscous fluxes of unlimited
/// gradients.
class Residual {
 public:
  /// Mesh and model must outlive the object.
  Residual(const DualMesh& mesh, const FlowModel& model, const EulerOptions& options);

  /// `states` has an entry for each node; those of ghosts are updated first. The result has an entry for each
  /// node, valid for owned nodes; components prescribed by no-slip walls are 0. *Collective.*
  const IdVector<NodeId, Flux>& evaluate(IdVector<NodeId, State>& states);

  const NoSlipNodes& no_slip() const { return no_slip_; }
  /// Friction force of the walls on the fluid per unit depth, from the last evaluation: an entry for each
  /// node; empty in inviscid flow.
  const IdVector<NodeId, Point>& friction() const { return friction_; }

  /// Sets the flow beyond far-field boundaries; initially the free stream.
  void surround(const FarField& far_field) { far_field_ = far_field; }

  /// Freezes the limiter's factors and the shock sensor's shares.
  void freeze_limiter();
  void release_limiter();
  bool limiter_is_live() const { return limiter_ && !limiter_->frozen(); }
  bool limiter_is_frozen() const { return limiter_ && limiter_->frozen(); }

  /// Limited gradients of all nodes, from the last evaluation.
  const IdVector<NodeId, Gradient>& gradients() const { return gradients_; }
  const LeastSquares& least_squares() const { return least_squares_; }
  const Limiter* limiter() const { return limiter_ ? &*limiter_ : nullptr; }
  /// Null without a limiter.
  const ShockSensor* shocks() const { return shocks_ ? &*shocks_ : nullptr; }
  double shock_share(NodeId a, NodeId b) const { return shocks_ ? shocks_->share(a, b) : 0; }

 private:
  void add_edges(const IdVector<NodeId, State>& states);
  void add_skew(const IdVector<NodeId, State>& states);
  void add_faces(const IdVector<NodeId, State>& states);
  Flux through(const BoundaryFace& face, const State& state) const;
  void find_viscous_gradients(const IdVector<NodeId, State>& states);
  void take_viscous_edges(const IdVector<NodeId, State>& states);
  void take_viscous_faces(const IdVector<NodeId, State>& states);

  const DualMesh& mesh_;
  const FlowModel& model_;
  LeastSquares least_squares_;
  std::optional<Limiter> limiter_;
  std::optional<ShockSensor> shocks_;
  IdVector<NodeId, Gradient> gradients_;
  IdVector<NodeId, Flux> sums_;
  NoSlipNodes no_slip_;
  std::optional<FarField> far_field_;
  IdVector<NodeId, ViscousGradient> viscous_gradients_;  ///< in viscous flow
  IdVector<NodeId, Point> friction_;
};

/// States on both sides of an edge's midpoint.
struct EdgeStates {
  State left, right;
  bool reconstructed;  ///< false: the states of the nodes
};

/// If a reconstructed density or pressure would be close to zero, the edge uses the states of the nodes:
/// first order.
EdgeStates states_at_middle(const DualEdge& edge, const IdVector<NodeId, State>& states,
                            const IdVector<NodeId, Gradient>& gradients);

/// Returns the contribution of a SkewEdge to the flux through its edge's face, from the means of the two
/// nodes' states and gradients.
template <class Real = double>
FluxOf<Real> skew_flux(const Gas& gas, const SkewEdge& skew, const StateOf<Real>& state,
                       const StateOf<Real>& along_x, const StateOf<Real>& along_y) {
  const FluxOf<Real> from_x = flux_change(gas, state, along_x, skew.with_x),
                     from_y = flux_change(gas, state, along_y, skew.with_y);
  return {from_x[0] + from_y[0], from_x[1] + from_y[1], from_x[2] + from_y[2], from_x[3] + from_y[3]};
}

/// Returns the state at one node's half of a boundary face. It is closer to the node's own state than the
/// half's midpoint; this compensates what the boundary edge passes on (see SkewEdge), so that the fluxes of a
/// linear field sum exactly there too.
inline State state_at_half(const BoundaryFace& face, const State& own, const State& other) {
  State state;
  for (std::size_t k = 0; k < 4; ++k) state[k] = own[k] + face.blend * (other[k] - own[k]) / 6;
  return state;
}

}  // namespace quadloop::flow::euler
