#pragma once

#include <optional>
#include <vector>

#include "flow/euler/scheme/dual_mesh.hpp"
#include "flow/euler/scheme/far_field.hpp"
#include "flow/euler/scheme/flow_model.hpp"
#include "flow/euler/scheme/no_slip.hpp"
#include "flow/euler/scheme/reconstruction.hpp"
#include "flow/euler/scheme/shock_sensor.hpp"
#include "flow/euler/scheme/viscous.hpp"

namespace quadloop::euler {

/// The net flux out of each owned node's dual cell: second order, with states at the middles of edges from
/// limited gradients and Roe's flux between them; a viscous flow's less what gradients not limited carry.
class Residual {
 public:
  /// Both must outlive it.
  Residual(const DualMesh& mesh, const FlowModel& model, const EulerOptions& options);

  /// `states` has an entry for each node; those of copies are brought up to date first. The result has one
  /// for each node too, of which those of owned nodes count; what no-slip walls decide is 0. *Collective.*
  const std::vector<Flux>& evaluate(std::vector<State>& states);

  const NoSlipNodes& no_slip() const { return no_slip_; }
  /// The force per depth on the fluid by the walls' friction, by the last evaluation: an entry for each node,
  /// none where the flow is not viscous.
  const std::vector<Point>& friction() const { return friction_; }

  /// What lies beyond far fields from now on: the free stream, until it is given a vortex.
  void surround(const FarField& far_field) { far_field_ = far_field; }

  /// From now on the limiter's factors stay as they are.
  void freeze_limiter();
  void release_limiter();
  bool limiter_is_live() const { return limiter_ && !limiter_->frozen(); }
  bool limiter_is_frozen() const { return limiter_ && limiter_->frozen(); }

 private:
  void add_edges(const std::vector<State>& states);
  void add_skew(const std::vector<State>& states);
  void add_faces(const std::vector<State>& states);
  void find_viscous_gradients(const std::vector<State>& states);
  void take_viscous_edges(const std::vector<State>& states);
  void take_viscous_faces(const std::vector<State>& states);

  const DualMesh& mesh_;
  const FlowModel& model_;
  LeastSquares least_squares_;
  std::optional<Limiter> limiter_;
  std::optional<ShockSensor> shocks_;  ///< where gradients are limited
  std::vector<Gradient> gradients_;
  std::vector<Flux> sums_;
  NoSlipNodes no_slip_;
  std::optional<FarField> far_field_;
  std::vector<ViscousGradient> viscous_gradients_;  ///< of a viscous flow
  std::vector<Point> friction_;
};

/// What acts on one node's half of a boundary face: nearer to the node's own state than the half's middle is,
/// which makes up for what the edge along the boundary leaves over (see SkewEdge). The fluxes of a linear
/// field then add up exactly there too.
inline State state_at_half(const BoundaryFace& face, const State& own, const State& other) {
  State state;
  for (std::size_t k = 0; k < 4; ++k) state[k] = own[k] + face.blend * (other[k] - own[k]) / 6;
  return state;
}

}  // namespace quadloop::euler
