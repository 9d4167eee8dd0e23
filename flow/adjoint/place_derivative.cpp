#include "flow/adjoint/place_derivative.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "flow/euler/model/dual_number.hpp"
#include "flow/euler/model/flux.hpp"
#include "mesher/base/parallel/exchange.hpp"

namespace quadloop::flow::euler {

namespace {

template <class Real>
VectorOf<Real> operator+(const VectorOf<Real>& a, const VectorOf<Real>& b) {
  return {a.x + b.x, a.y + b.y};
}
template <class Real>
VectorOf<Real> operator-(const VectorOf<Real>& a, const VectorOf<Real>& b) {
  return {a.x - b.x, a.y - b.y};
}
template <class Real>
VectorOf<Real> operator*(double factor, const VectorOf<Real>& a) {
  return {factor * a.x, factor * a.y};
}
/// Rotates by 90 degrees clockwise.
template <class Real>
VectorOf<Real> turned(const VectorOf<Real>& v) {
  return {v.y, -v.x};
}
template <class Real>
Real length_of(const VectorOf<Real>& v) {
  using std::sqrt;
  return sqrt(v.x * v.x + v.y * v.y);
}
template <class Real>
Real weighted_sum(const Flux& weight, const FluxOf<Real>& flux) {
  return weight[0] * flux[0] + weight[1] * flux[1] + weight[2] * flux[2] + weight[3] * flux[3];
}

template <class Real>
StateOf<Real> constant(const State& state) {
  StateOf<Real> result;
  std::ranges::copy(state, result.begin());
  return result;
}

/// Derivative of psi . residual with respect to an edge's face: its normal, whose length is that of the face,
/// and its skewness.
struct FaceWeights {
  std::array<double, 2> normal{};
  std::array<double, 4> skew{};  ///< with respect to SkewEdge's with_x and with_y
};

class PlaceDerivative {
 public:
  PlaceDerivative(const LinearResidual& linear, const IdVector<NodeId, Flux>& adjoint)
      : linear_{linear},
        run_{linear.run()},
        adjoint_{adjoint},
        sums_(run_.mesh.nodes()),
        areas_(run_.mesh.nodes(), 0.0) {}

  /// Returns the derivative of psi . residual.
  IdVector<NodeId, Point> find() {
    add_edges();
    add_gradients();
    add_boundaries();
    add_cells();
    sums_.resize(run_.mesh.owned_nodes());
    return std::move(sums_);
  }

 private:
  Flux fall(const DualEdge& edge) const {
    Flux result;
    for (std::size_t k = 0; k < 4; ++k) result[k] = adjoint_[edge.low][k] - adjoint_[edge.high][k];
    return result;
  }
  /// Adds the weight of an edge's half vector to its ends.
  void add_half(const DualEdge& edge, Point weight) {
    sums_[edge.low] = sums_[edge.low] - 0.5 * weight;
    sums_[edge.high] = sums_[edge.high] + 0.5 * weight;
  }
  void add_edges();
  void add_gradients();
  void add_boundaries();
  void add_cells();
  void add_upwind(const DualEdge& edge, FaceWeights& weights);
  void add_skew(const DualEdge& edge, FaceWeights& weights) const;
  std::vector<FaceWeights> weights_of_cell_edges() const;
  template <class Nodes>
  void add_cell(const Nodes& nodes, std::vector<FaceWeights>::const_iterator weights);

  const LinearResidual& linear_;
  const FlowRun& run_;
  const IdVector<NodeId, Flux>& adjoint_;
  IdVector<NodeId, Point> sums_;
  IdVector<NodeId, double> areas_;  ///< derivative with respect to the nodes' dual areas, via the limiter
  std::vector<FaceWeights> edges_;
};

void PlaceDerivative::add_edges() {
  for (const DualEdge& edge : run_.mesh.edges()) {
    FaceWeights weights;
    add_upwind(edge, weights);
    add_skew(edge, weights);
    edges_.push_back(weights);
  }
}

/// The variables are the face's normal and the half vector along the edge.
void PlaceDerivative::add_upwind(const DualEdge& edge, FaceWeights& weights) {
  using Dual = DualNumber<4>;
  if (edge.size == 0) return;
  const IdVector<NodeId, Gradient>& gradients = run_.residual.gradients();
  const VectorOf<Dual> face{Dual::variable(edge.size * edge.normal.x, 0),
                            Dual::variable(edge.size * edge.normal.y, 1)},
      half{Dual::variable(edge.half.x, 2), Dual::variable(edge.half.y, 3)};
  const bool reconstructed = states_at_middle(edge, run_.states, gradients).reconstructed;
  const auto transferred = [&](NodeId node, double way) {
    StateOf<Dual> state = constant<Dual>(run_.states[node]);
    for (std::size_t k = 0; reconstructed && k < 4; ++k)
      state[k] = state[k] + way * (gradients[node].x[k] * half.x + gradients[node].y[k] * half.y);
    return state;
  };
  const Dual size = length_of(face);
  const VectorOf<Dual> normal{face.x / size, face.y / size};
  const FluxOf<Dual> flux = roe_flux(run_.model.gas, transferred(edge.low, 1), transferred(edge.high, -1),
                                     normal, run_.residual.shock_share(edge.low, edge.high));
  const Dual term = size * weighted_sum(fall(edge), flux);
  weights.normal = {term.slopes[0], term.slopes[1]};
  add_half(edge, {term.slopes[2], term.slopes[3]});
}

/// The flux is proportional to the skewness, so the derivative exists where that is 0 too.
void PlaceDerivative::add_skew(const DualEdge& edge, FaceWeights& weights) const {
  const IdVector<NodeId, Gradient>& gradients = run_.residual.gradients();
  const Gradient &low = gradients[edge.low], &high = gradients[edge.high];
  State state, along_x, along_y;
  for (std::size_t k = 0; k < 4; ++k) {
    state[k] = 0.5 * (run_.states[edge.low][k] + run_.states[edge.high][k]);
    along_x[k] = 0.5 * (low.x[k] + high.x[k]);
    along_y[k] = 0.5 * (low.y[k] + high.y[k]);
  }
  const Flux weight = fall(edge);
  const std::array<SkewEdge, 4> units{{{0, {1, 0}, {}}, {0, {0, 1}, {}}, {0, {}, {1, 0}}, {0, {}, {0, 1}}}};
  for (std::size_t i = 0; i < 4; ++i)
    weights.skew[i] = weighted_sum(weight, skew_flux(run_.model.gas, units[i], state, along_x, along_y));
}

/// Gradients depend on positions by least squares and, unless frozen, by the limiter.
void PlaceDerivative::add_gradients() {
  using Dual = DualNumber<2>;
  IdVector<NodeId, Gradient> weights = linear_.limited_gradient_weights(adjoint_);
  IdVector<NodeId, State> of_states(run_.mesh.nodes());
  if (linear_.limiter()) {
    linear_.limiter()->add_place_weights(weights, sums_, areas_);
    linear_.limiter()->apply_transposed(weights, of_states);
  }
  IdVector<NodeId, Gradient> gradients(run_.mesh.nodes());
  run_.residual.least_squares().compute(run_.states, gradients);
  run_.mesh.exchange().update(gradients);
  const IdVector<NodeId, Gradient> solved = run_.residual.least_squares().solved(weights);
  for (const DualEdge& edge : run_.mesh.edges()) {
    const VectorOf<Dual> half{Dual::variable(edge.half.x, 0), Dual::variable(edge.half.y, 1)};
    const Dual weight = 1 / (half.x * half.x + half.y * half.y);
    Dual term;
    for (const NodeId node : {edge.low, edge.high}) {
      const Gradient &by = solved[node], &gradient = gradients[node];
      for (std::size_t k = 0; k < 4; ++k) {
        const double rise = run_.states[edge.high][k] - run_.states[edge.low][k];
        term = term + weight * (by.x[k] * half.x + by.y[k] * half.y) *
                          (0.5 * rise - (gradient.x[k] * half.x + gradient.y[k] * half.y));
      }
    }
    add_half(edge, {term.slopes[0], term.slopes[1]});
  }
}

void PlaceDerivative::add_boundaries() {
  using Dual = DualNumber<4>;
  for (const BoundaryFace& face : run_.mesh.faces()) {
    const Point a = run_.mesh.point(face.from), b = run_.mesh.point(face.to);
    const VectorOf<Dual> from{Dual::variable(a.x, 0), Dual::variable(a.y, 1)},
        to{Dual::variable(b.x, 2), Dual::variable(b.y, 3)}, outward = 0.5 * turned(to - from);
    const Dual size = length_of(outward);
    const VectorOf<Dual> normal{outward.x / size, outward.y / size};
    const BoundaryModel& boundary = run_.model.boundaries[face.boundary];
    for (const auto& [own, other] : {std::pair{face.from, face.to}, {face.to, face.from}}) {
      const State state = state_at_half(face, run_.states[own], run_.states[other]);
      const Dual term = size * weighted_sum(adjoint_[own], boundary_flux(run_.model, boundary,
                                                                         constant<Dual>(state), normal));
      sums_[face.from] = sums_[face.from] + Point{term.slopes[0], term.slopes[1]};
      sums_[face.to] = sums_[face.to] + Point{term.slopes[2], term.slopes[3]};
    }
  }
}

/// Returns the weights of the edges of all cells that touch an owned node, cell by cell, from the owner of
/// the edge's lower node, as this rank has incomplete faces for edges without an owned node.
std::vector<FaceWeights> PlaceDerivative::weights_of_cell_edges() const {
  using Key = std::array<GlobalNodeId, 2>;
  const HaloMesh& halo = run_.mesh.halo();
  const NodeOwners owners(run_.comm, run_.mesh.first_node());
  std::vector<Key> keys;
  std::vector<int> ranks;
  halo.for_each_cell([&](const auto& nodes) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const GlobalNodeId a = halo.global(nodes[i]), b = halo.global(nodes[(i + 1) % nodes.size()]);
      keys.push_back({std::min(a, b), std::max(a, b)});
      ranks.push_back(owners.rank_of(keys.back()[0]));
    }
  });
  const auto edges = run_.mesh.edges();
  const auto key_of = [&](const DualEdge& edge) {
    return Key{run_.mesh.global(edge.low), run_.mesh.global(edge.high)};
  };
  const Exchange exchange(run_.comm, ranks);
  std::vector<FaceWeights> answers;
  for (const Key& key : exchange.deliver(keys)) {
    const auto found = std::ranges::lower_bound(edges, key, {}, key_of);
    answers.push_back(edges_[found - edges.begin()]);
  }
  return exchange.answer(answers);
}

void PlaceDerivative::add_cells() {
  run_.mesh.exchange().update(areas_);
  const std::vector<FaceWeights> weights = weights_of_cell_edges();
  auto next = weights.begin();
  run_.mesh.halo().for_each_cell([&](const auto& nodes) {
    add_cell(nodes, next);
    next += static_cast<std::ptrdiff_t>(nodes.size());
  });
}

/// Adds one cell's contributions to its edges' faces and its nodes' areas.
template <class Nodes>
void PlaceDerivative::add_cell(const Nodes& nodes, std::vector<FaceWeights>::const_iterator weights) {
  constexpr std::size_t n = std::tuple_size_v<Nodes>;
  using Dual = DualNumber<2 * n>;
  std::array<VectorOf<Dual>, n> places;
  VectorOf<Dual> centre{};
  for (std::size_t i = 0; i < n; ++i) {
    const Point at = run_.mesh.point(nodes[i]);
    places[i] = {Dual::variable(at.x, 2 * i), Dual::variable(at.y, 2 * i + 1)};
    centre = centre + 1.0 / static_cast<double>(n) * places[i];
  }
  Dual term;
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t after = (i + 1) % n, before = (i + n - 1) % n;
    const FaceWeights& of_face = *(weights + static_cast<std::ptrdiff_t>(i));
    const double side = run_.mesh.global(nodes[i]) < run_.mesh.global(nodes[after]) ? 1 : -1;
    const VectorOf<Dual> along = places[after] - places[i],
                         across = centre - 0.5 * (places[after] + places[i]), normal = side * turned(across);
    term = term + of_face.normal[0] * normal.x + of_face.normal[1] * normal.y;
    if (n == 4) {
      const auto skew = [&](const Dual& across_part, const Dual& along_part, std::size_t k) {
        const VectorOf<Dual> over = side / 24 * turned(along);
        return of_face.skew[k] * (0.5 * across_part * normal.x + along_part * over.x) +
               of_face.skew[k + 1] * (0.5 * across_part * normal.y + along_part * over.y);
      };
      term = term + skew(across.x, along.x, 0) + skew(across.y, along.y, 2);
    }
    const VectorOf<Dual> out = centre - places[i], apart = 0.5 * (places[before] - places[after]);
    term = term + 0.5 * areas_[nodes[i]] * (out.x * apart.y - out.y * apart.x);
  }
  for (std::size_t i = 0; i < n; ++i) {
    Point& sum = sums_[nodes[i]];
    sum = sum + Point{term.slopes[2 * i], term.slopes[2 * i + 1]};
  }
}

}  // namespace

IdVector<NodeId, Point> place_derivative(const LinearResidual& linear, const GoalFunctional& goal,
                                         const IdVector<NodeId, Flux>& adjoint) {
  const FlowRun& run = linear.run();
  IdVector<NodeId, Point> of_goal(run.mesh.nodes());
  goal.add_place_derivative(run.states, of_goal);
  const IdVector<NodeId, Point> of_residual = PlaceDerivative(linear, adjoint).find();
  of_goal.resize(of_residual.size());
  for (const NodeId node : of_goal.ids()) of_goal[node] = of_goal[node] - of_residual[node];
  return of_goal;
}

}  // namespace quadloop::flow::euler
