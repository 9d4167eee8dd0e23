#include "flow/euler/scheme/residual.hpp"

#include "flow/euler/model/flux.hpp"

namespace quadloop::flow::euler {

namespace {

/// Fraction of the node's value that reconstructed density and pressure must keep.
constexpr double least_share = 0.1;

State extrapolated(const State& state, const Gradient& gradient, double x, double y) {
  State result;
  for (std::size_t k = 0; k < 4; ++k) result[k] = state[k] + (gradient.x[k] * x + gradient.y[k] * y);
  return result;
}

bool keeps_enough(const State& extrapolated, const State& state) {
  return extrapolated[0] > least_share * state[0] && extrapolated[3] > least_share * state[3];
}

}  // namespace

Residual::Residual(const DualMesh& mesh, const FlowModel& model, const EulerOptions& options)
    : mesh_{mesh},
      model_{model},
      least_squares_(mesh),
      gradients_(mesh.nodes()),
      sums_(mesh.nodes()),
      no_slip_(mesh, model) {
  if (model.is_viscous()) {
    viscous_gradients_.resize(mesh.nodes());
    friction_.resize(mesh.nodes());
  }
  if (options.limiter == EulerOptions::Limiter::venkatakrishnan) {
    limiter_.emplace(mesh, options.reference_length);
    shocks_.emplace(mesh, model.free_stream[3]);
  }
}

void Residual::freeze_limiter() {
  if (limiter_) limiter_->freeze();
  if (shocks_) shocks_->freeze();
}

void Residual::release_limiter() {
  if (limiter_) limiter_->release();
  if (shocks_) shocks_->release();
}

const IdVector<NodeId, Flux>& Residual::evaluate(IdVector<NodeId, State>& states) {
  mesh_.update(states);
  least_squares_.compute(states, gradients_);
  if (model_.is_viscous()) find_viscous_gradients(states);
  if (limiter_) limiter_->apply(states, gradients_);
  mesh_.update(gradients_);
  if (shocks_) shocks_->find(states);
  for (Flux& sum : sums_) sum = {};
  add_edges(states);
  add_skew(states);
  add_faces(states);
  if (model_.is_viscous()) {
    take_viscous_edges(states);
    take_viscous_faces(states);
    no_slip_.take_friction(sums_, friction_);
  }
  return sums_;
}

void Residual::find_viscous_gradients(const IdVector<NodeId, State>& states) {
  for (const NodeId node : mesh_.owned_ids())
    viscous_gradients_[node] = viscous_gradient(model_.gas, states[node], gradients_[node]);
  mesh_.update(viscous_gradients_);
}

void Residual::take_viscous_edges(const IdVector<NodeId, State>& states) {
  for (const DualEdge& edge : mesh_.edges()) {
    const NodeId low = edge.low, high = edge.high;
    State mean;
    for (std::size_t k = 0; k < 4; ++k) mean[k] = 0.5 * (states[low][k] + states[high][k]);
    const ViscousGradient gradient =
        gradient_between(model_.gas, states[low], states[high], viscous_gradients_[low],
                         viscous_gradients_[high], 2.0 * edge.half);
    const Flux flux = viscous_flux(model_, mean, gradient, edge.normal);
    for (std::size_t k = 1; k < 4; ++k) {
      sums_[low][k] -= edge.size * flux[k];
      sums_[high][k] += edge.size * flux[k];
    }
  }
}

void Residual::take_viscous_faces(const IdVector<NodeId, State>& states) {
  for (const BoundaryFace& face : mesh_.faces()) {
    const BoundaryModel& boundary = model_.boundaries[face.boundary];
    for (const auto& [own, other] : {std::pair{face.from, face.to}, {face.to, face.from}}) {
      const State state = state_at_half(face, states[own], states[other]);
      const Flux flux = viscous_boundary_flux(model_, boundary, state, viscous_gradients_[own], face.normal);
      for (std::size_t k = 1; k < 4; ++k) sums_[own][k] -= face.half_size * flux[k];
    }
  }
}

EdgeStates states_at_middle(const DualEdge& edge, const IdVector<NodeId, State>& states,
                            const IdVector<NodeId, Gradient>& gradients) {
  const NodeId low = edge.low, high = edge.high;
  const State left = extrapolated(states[low], gradients[low], edge.half.x, edge.half.y);
  const State right = extrapolated(states[high], gradients[high], -edge.half.x, -edge.half.y);
  if (!keeps_enough(left, states[low]) || !keeps_enough(right, states[high]))
    return {states[low], states[high], false};
  return {left, right, true};
}

void Residual::add_edges(const IdVector<NodeId, State>& states) {
  for (const DualEdge& edge : mesh_.edges()) {
    const NodeId low = edge.low, high = edge.high;
    const auto [left, right, reconstructed] = states_at_middle(edge, states, gradients_);
    const Flux flux = roe_flux(model_.gas, left, right, edge.normal, shock_share(edge.low, edge.high));
    for (std::size_t k = 0; k < 4; ++k) {
      const double through = edge.size * flux[k];
      sums_[low][k] += through;
      sums_[high][k] -= through;
    }
  }
}

void Residual::add_skew(const IdVector<NodeId, State>& states) {
  const auto edges = mesh_.edges();
  for (const SkewEdge& skew : mesh_.skew_edges()) {
    const NodeId low = edges[skew.edge].low, high = edges[skew.edge].high;
    State state, along_x, along_y;
    for (std::size_t k = 0; k < 4; ++k) {
      state[k] = 0.5 * (states[low][k] + states[high][k]);
      along_x[k] = 0.5 * (gradients_[low].x[k] + gradients_[high].x[k]);
      along_y[k] = 0.5 * (gradients_[low].y[k] + gradients_[high].y[k]);
    }
    const Flux through = skew_flux(model_.gas, skew, state, along_x, along_y);
    for (std::size_t k = 0; k < 4; ++k) {
      sums_[low][k] += through[k];
      sums_[high][k] -= through[k];
    }
  }
}

/// Flux through a boundary face, for an inner state.
Flux Residual::through(const BoundaryFace& face, const State& state) const {
  const BoundaryModel& boundary = model_.boundaries[face.boundary];
  if (!far_field_ || boundary.condition != Condition::farfield)
    return boundary_flux(model_, boundary, state, face.normal);
  const Point middle = 0.5 * (mesh_.point(face.from) + mesh_.point(face.to));
  return roe_flux(model_.gas, state, far_field_->at(middle), face.normal);
}

void Residual::add_faces(const IdVector<NodeId, State>& states) {
  for (const BoundaryFace& face : mesh_.faces()) {
    for (const auto& [own, other] : {std::pair{face.from, face.to}, {face.to, face.from}}) {
      const State state = state_at_half(face, states[own], states[other]);
      const Flux flux = through(face, state);
      for (std::size_t k = 0; k < 4; ++k) sums_[own][k] += face.half_size * flux[k];
    }
  }
}

}  // namespace quadloop::flow::euler
