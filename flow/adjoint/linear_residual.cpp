#include "flow/adjoint/linear_residual.hpp"

#include <algorithm>
#include <utility>

#include "flow/euler/model/dual_number.hpp"

namespace quadloop::flow::euler {

namespace {

/// Returns `state` as the independent variables `first` to `first` + 3.
template <class Dual>
StateOf<Dual> as_variables(const State& state, std::size_t first) {
  StateOf<Dual> variables;
  for (std::size_t k = 0; k < 4; ++k) variables[k] = Dual::variable(state[k], first + k);
  return variables;
}

/// Returns the flux's derivatives with respect to four of the variables, times `size`.
template <class Dual>
Matrix4 slopes(const FluxOf<Dual>& flux, std::size_t first, double size) {
  Matrix4 matrix;
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column)
      matrix[4 * row + column] = size * flux[row].slopes[first + column];
  }
  return matrix;
}

void add_product(const Matrix4& matrix, const State& vector, Flux& sum) {
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) sum[row] += matrix[4 * row + column] * vector[column];
  }
}

void add_transposed_product(const Matrix4& matrix, const Flux& vector, State& sum) {
  for (std::size_t row = 0; row < 4; ++row) {
    for (std::size_t column = 0; column < 4; ++column) sum[column] += matrix[4 * row + column] * vector[row];
  }
}

State mean(const State& a, const State& b) {
  State result;
  for (std::size_t k = 0; k < 4; ++k) result[k] = 0.5 * (a[k] + b[k]);
  return result;
}

Flux difference(const Flux& a, const Flux& b) {
  Flux result;
  for (std::size_t k = 0; k < 4; ++k) result[k] = a[k] - b[k];
  return result;
}

void add(const State& added, double factor, State& sum) {
  for (std::size_t k = 0; k < 4; ++k) sum[k] += factor * added[k];
}

State stepped(const State& state, const Gradient& gradient, Point way) {
  State result = state;
  add(gradient.x, way.x, result);
  add(gradient.y, way.y, result);
  return result;
}

}  // namespace

LinearResidual::LinearResidual(FlowRun& run) : run_{run} {
  run.residual.evaluate(run.states);
  if (const Limiter* const limiter = run.residual.limiter()) {
    IdVector<NodeId, Gradient> gradients(run.mesh.nodes());
    run.residual.least_squares().compute(run.states, gradients);
    limiter_.emplace(run.mesh, *limiter, run.states, std::move(gradients));
  }
  if (const ShockSensor* const shocks = run.residual.shocks()) {
    shocks_.emplace(run.comm, run.mesh, *shocks, run.states);
    if (!shocks_->acts()) shocks_.reset();
  }
  differentiate_edges();
  differentiate_skew();
  differentiate_faces();
}

void LinearResidual::differentiate_edges() {
  using Dual = DualNumber<9>;
  const Residual& residual = run_.residual;
  for (const DualEdge& edge : run_.mesh.edges()) {
    const auto [left, right, reconstructed] = states_at_middle(edge, run_.states, residual.gradients());
    const double share = residual.shock_share(edge.low, edge.high);
    const FluxOf<Dual> flux = roe_flux(run_.model.gas, as_variables<Dual>(left, 0),
                                       as_variables<Dual>(right, 4), edge.normal, Dual::variable(share, 8));
    if (shocks_ && share > 0) {
      ShockPart part{edges_.size(), residual.shocks()->decider(edge.low, edge.high), {}};
      for (std::size_t k = 0; k < 4; ++k) part.by_share[k] = edge.size * flux[k].slopes[8];
      shock_edges_.push_back(part);
    }
    edges_.push_back({slopes(flux, 0, edge.size), slopes(flux, 4, edge.size), reconstructed});
  }
}

void LinearResidual::differentiate_skew() {
  using Dual = DualNumber<12>;
  const IdVector<NodeId, Gradient>& gradients = run_.residual.gradients();
  for (const SkewEdge& skew : run_.mesh.skew_edges()) {
    const DualEdge& edge = run_.mesh.edges()[skew.edge];
    const Gradient &low = gradients[edge.low], &high = gradients[edge.high];
    const State state = mean(run_.states[edge.low], run_.states[edge.high]);
    const FluxOf<Dual> flux =
        skew_flux(run_.model.gas, skew, as_variables<Dual>(state, 0),
                  as_variables<Dual>(mean(low.x, high.x), 4), as_variables<Dual>(mean(low.y, high.y), 8));
    skew_.push_back({slopes(flux, 0, 1), slopes(flux, 4, 1), slopes(flux, 8, 1)});
  }
}

void LinearResidual::differentiate_faces() {
  using Dual = DualNumber<4>;
  for (const BoundaryFace& face : run_.mesh.faces()) {
    const BoundaryModel& boundary = run_.model.boundaries[face.boundary];
    const auto half = [&](NodeId own, NodeId other) {
      const State state = state_at_half(face, run_.states[own], run_.states[other]);
      return slopes(boundary_flux(run_.model, boundary, as_variables<Dual>(state, 0), face.normal), 0,
                    face.half_size);
    };
    faces_.push_back({half(face.from, face.to), half(face.to, face.from)});
  }
}

void LinearResidual::apply(IdVector<NodeId, State>& change, IdVector<NodeId, Flux>& sums) const {
  run_.mesh.exchange().update(change);
  IdVector<NodeId, Gradient> gradients(run_.mesh.nodes());
  run_.residual.least_squares().compute(change, gradients);
  if (limiter_) limiter_->apply(change, gradients);
  run_.mesh.exchange().update(gradients);
  sums = IdVector<NodeId, Flux>(run_.mesh.nodes());
  apply_edges(change, gradients, sums);
  if (shocks_) apply_shocks(change, sums);
  apply_faces(change, sums);
}

void LinearResidual::apply_edges(const IdVector<NodeId, State>& change,
                                 const IdVector<NodeId, Gradient>& gradients,
                                 IdVector<NodeId, Flux>& sums) const {
  const auto edges = run_.mesh.edges();
  const auto carry = [&](const DualEdge& edge, const Flux& through) {
    add(through, 1, sums[edge.low]);
    add(through, -1, sums[edge.high]);
  };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const DualEdge& edge = edges[e];
    const double share = edges_[e].reconstructed ? 1 : 0;
    Flux through{};
    add_product(edges_[e].by_left, stepped(change[edge.low], gradients[edge.low], share * edge.half),
                through);
    add_product(edges_[e].by_right, stepped(change[edge.high], gradients[edge.high], -share * edge.half),
                through);
    carry(edge, through);
  }
  for (std::size_t s = 0; s < skew_.size(); ++s) {
    const DualEdge& edge = edges[run_.mesh.skew_edges()[s].edge];
    const Gradient &low = gradients[edge.low], &high = gradients[edge.high];
    Flux through{};
    add_product(skew_[s].by_state, mean(change[edge.low], change[edge.high]), through);
    add_product(skew_[s].by_x, mean(low.x, high.x), through);
    add_product(skew_[s].by_y, mean(low.y, high.y), through);
    carry(edge, through);
  }
}

void LinearResidual::apply_shocks(const IdVector<NodeId, State>& change, IdVector<NodeId, Flux>& sums) const {
  const IdVector<NodeId, double> shares = shocks_->apply(change);
  for (const ShockPart& part : shock_edges_) {
    const DualEdge& edge = run_.mesh.edges()[part.edge];
    add(part.by_share, shares[part.node], sums[edge.low]);
    add(part.by_share, -shares[part.node], sums[edge.high]);
  }
}

void LinearResidual::apply_faces(const IdVector<NodeId, State>& change, IdVector<NodeId, Flux>& sums) const {
  const auto faces = run_.mesh.faces();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const auto& [from, to, boundary, normal, half_size, blend] = faces[f];
    add_product(faces_[f][0], state_at_half(faces[f], change[from], change[to]), sums[from]);
    add_product(faces_[f][1], state_at_half(faces[f], change[to], change[from]), sums[to]);
  }
}

/// Sums of owned nodes are in the order of edges and faces, as in Residual.
void LinearResidual::apply_transposed(IdVector<NodeId, Flux>& weights, IdVector<NodeId, State>& sums) const {
  run_.mesh.exchange().update(weights);
  sums = IdVector<NodeId, State>(run_.mesh.nodes());
  IdVector<NodeId, Gradient> gradients(run_.mesh.nodes());
  transpose_edges(weights, sums, gradients);
  transpose_faces(weights, sums);
  if (shocks_) transpose_shocks(weights, sums);
  if (limiter_) limiter_->apply_transposed(gradients, sums);
  run_.residual.least_squares().add_transposed(gradients, sums);
}

IdVector<NodeId, Gradient> LinearResidual::limited_gradient_weights(
    const IdVector<NodeId, Flux>& weights) const {
  IdVector<NodeId, State> sums(run_.mesh.nodes());
  IdVector<NodeId, Gradient> gradients(run_.mesh.nodes());
  transpose_edges(weights, sums, gradients);
  return gradients;
}

void LinearResidual::transpose_edges(const IdVector<NodeId, Flux>& weights, IdVector<NodeId, State>& sums,
                                     IdVector<NodeId, Gradient>& gradients) const {
  const auto edges = run_.mesh.edges();
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const DualEdge& edge = edges[e];
    const Flux weight = difference(weights[edge.low], weights[edge.high]);
    State left{}, right{};
    add_transposed_product(edges_[e].by_left, weight, left);
    add_transposed_product(edges_[e].by_right, weight, right);
    add(left, 1, sums[edge.low]);
    add(right, 1, sums[edge.high]);
    if (!edges_[e].reconstructed) continue;
    add(left, edge.half.x, gradients[edge.low].x);
    add(left, edge.half.y, gradients[edge.low].y);
    add(right, -edge.half.x, gradients[edge.high].x);
    add(right, -edge.half.y, gradients[edge.high].y);
  }
  for (std::size_t s = 0; s < skew_.size(); ++s) {
    const DualEdge& edge = edges[run_.mesh.skew_edges()[s].edge];
    const Flux weight = difference(weights[edge.low], weights[edge.high]);
    State by_state{}, by_x{}, by_y{};
    add_transposed_product(skew_[s].by_state, weight, by_state);
    add_transposed_product(skew_[s].by_x, weight, by_x);
    add_transposed_product(skew_[s].by_y, weight, by_y);
    for (const NodeId node : {edge.low, edge.high}) {
      add(by_state, 0.5, sums[node]);
      add(by_x, 0.5, gradients[node].x);
      add(by_y, 0.5, gradients[node].y);
    }
  }
}

/// The weight of a share is complete where its node is owned: all of its edges are on this rank.
void LinearResidual::transpose_shocks(const IdVector<NodeId, Flux>& weights,
                                      IdVector<NodeId, State>& sums) const {
  IdVector<NodeId, double> shares(run_.mesh.nodes());
  for (const ShockPart& part : shock_edges_) {
    const DualEdge& edge = run_.mesh.edges()[part.edge];
    const Flux weight = difference(weights[edge.low], weights[edge.high]);
    for (std::size_t k = 0; k < 4; ++k) shares[part.node] += part.by_share[k] * weight[k];
  }
  shocks_->add_transposed(shares, sums);
}

void LinearResidual::transpose_faces(const IdVector<NodeId, Flux>& weights,
                                     IdVector<NodeId, State>& sums) const {
  const auto faces = run_.mesh.faces();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const BoundaryFace& face = faces[f];
    const double of_other = face.blend / 6;
    State at_from{}, at_to{};
    add_transposed_product(faces_[f][0], weights[face.from], at_from);
    add_transposed_product(faces_[f][1], weights[face.to], at_to);
    add(at_from, 1 - of_other, sums[face.from]);
    add(at_to, of_other, sums[face.from]);
    add(at_to, 1 - of_other, sums[face.to]);
    add(at_from, of_other, sums[face.to]);
  }
}

}  // namespace quadloop::flow::euler
