#include "flow/adjoint/goal_error.hpp"

#include <cmath>
#include <tuple>
#include <type_traits>
#include <utility>

#include "flow/euler/model/flux.hpp"
#include "flow/euler/scheme/residual.hpp"
#include "mesher/base/parallel/reproducible_sum.hpp"

namespace quadloop::flow::euler {

namespace {

double product(const Flux& a, const Flux& b) {
  return a[0] * b[0] + a[1] * b[1] + (a[2] * b[2] + a[3] * b[3]);
}

Flux sum_of(double a, const Flux& x, double b, const Flux& y) {
  Flux result;
  for (std::size_t k = 0; k < 4; ++k) result[k] = a * x[k] + b * y[k];
  return result;
}

bool is_physical(const State& state) { return state[0] > 0 && state[3] > 0; }

/// Terms of each cell's contribution, along its edges.
class CellParts {
 public:
  CellParts(const FlowRun& run, const IdVector<NodeId, Flux>& adjoint)
      : run_{run}, adjoint_{adjoint}, gradients_(run.mesh.nodes()) {
    run.residual.least_squares().compute(run.states, gradients_);
    run.mesh.exchange().update(gradients_);
  }

  /// Midpoint of an edge: cubic interpolation of states and gradients at its ends.
  State state_between(NodeId a, NodeId b) const {
    const Point way = run_.mesh.point(b) - run_.mesh.point(a);
    const State mean = sum_of(0.5, run_.states[a], 0.5, run_.states[b]);
    State middle = mean;
    for (std::size_t k = 0; k < 4; ++k) {
      const double bend = (gradients_[b].x[k] - gradients_[a].x[k]) * way.x +
                          (gradients_[b].y[k] - gradients_[a].y[k]) * way.y;
      middle[k] -= bend / 8;
    }
    return is_physical(middle) ? middle : mean;
  }

  Flux flux(const State& state, Point normal) const { return physical_flux(run_.model.gas, state, normal); }
  Flux rise(NodeId a, NodeId b) const { return sum_of(1, adjoint_[b], -1, adjoint_[a]); }

  /// Returns the sum over the cell's edges of the adjoint's difference times the scheme's flux through the
  /// edge's face in the cell.
  template <class Nodes>
  double by_scheme(const Nodes& nodes, Point centre) const {
    double sum = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const NodeId a = nodes[i], b = nodes[(i + 1) % nodes.size()];
      sum += product(rise(a, b), flux_in_cell(a, b, centre, nodes.size() == 4));
    }
    return sum;
  }

  /// Returns the integral of the gradient of the adjoint times the higher-order flux.
  double integral(const std::array<NodeId, 3>& nodes) const;
  double integral(const std::array<NodeId, 4>& nodes) const;

 private:
  /// Returns the flux from a to b through the face between the edge's midpoint and the cell's centre; in
  /// quads including the skewness.
  Flux flux_in_cell(NodeId a, NodeId b, Point centre, bool is_quad) const {
    const Point from = run_.mesh.point(a), to = run_.mesh.point(b), across = centre - 0.5 * (from + to);
    const double size = length(across);
    const Point normal = size > 0 ? (1 / size) * turned(across) : Point{};
    const IdVector<NodeId, Gradient>& gradients = run_.residual.gradients();
    const DualEdge edge{a, b, normal, size, 0.5 * (to - from)};
    const EdgeStates ends = states_at_middle(edge, run_.states, gradients);
    const Flux flux =
        roe_flux(run_.model.gas, ends.left, ends.right, normal, run_.residual.shock_share(a, b));
    if (!is_quad) return sum_of(size, flux, 0, flux);
    const Point along = to - from;
    const SkewEdge skew{0, 0.5 * across.x * turned(across) + along.x / 24 * turned(along),
                        0.5 * across.y * turned(across) + along.y / 24 * turned(along)};
    const Flux more = skew_flux(run_.model.gas, skew, sum_of(0.5, run_.states[a], 0.5, run_.states[b]),
                                sum_of(0.5, gradients[a].x, 0.5, gradients[b].x),
                                sum_of(0.5, gradients[a].y, 0.5, gradients[b].y));
    return sum_of(size, flux, 1, more);
  }

  /// Rotates by 90 degrees clockwise.
  static Point turned(Point v) { return {v.y, -v.x}; }

  const FlowRun& run_;
  const IdVector<NodeId, Flux>& adjoint_;
  IdVector<NodeId, Gradient> gradients_;
};

/// Edge-midpoint rule, exact for quadratics; the gradients of the shape functions are the rotated opposite
/// edges.
double CellParts::integral(const std::array<NodeId, 3>& nodes) const {
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const NodeId a = nodes[i], b = nodes[(i + 1) % 3];
    const State middle = state_between(a, b);
    for (std::size_t n = 0; n < 3; ++n) {
      const Point opposite = run_.mesh.point(nodes[(n + 2) % 3]) - run_.mesh.point(nodes[(n + 1) % 3]);
      // half of the inward normal is the gradient of the node's shape function times the area
      const Point inward{-0.5 * opposite.y, 0.5 * opposite.x};
      sum += product(adjoint_[nodes[n]], flux(middle, inward)) / 3;
    }
  }
  return sum;
}

/// Simpson's rule in both directions.
double CellParts::integral(const std::array<NodeId, 4>& nodes) const {
  std::array<State, 9> states;  // row by row
  constexpr std::array<std::size_t, 4> corners{0, 2, 8, 6}, middles{1, 5, 7, 3};
  State centre{};
  for (std::size_t i = 0; i < 4; ++i) {
    const NodeId a = nodes[i], b = nodes[(i + 1) % 4];
    states[corners[i]] = run_.states[a];
    states[middles[i]] = state_between(a, b);
    for (std::size_t k = 0; k < 4; ++k)
      centre[k] += 0.5 * states[middles[i]][k] - 0.25 * states[corners[i]][k];
  }
  states[4] = centre;
  if (!is_physical(centre)) {
    states[4] = {};
    for (const std::size_t i : corners) states[4] = sum_of(1, states[4], 0.25, states[i]);
  }
  constexpr std::array<double, 3> weights{1.0 / 6, 4.0 / 6, 1.0 / 6};
  const auto point = [&](std::size_t i) { return run_.mesh.point(nodes[i]); };
  const auto psi = [&](std::size_t i) -> const Flux& { return adjoint_[nodes[i]]; };
  double sum = 0;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      const double s = 0.5 * static_cast<double>(column), t = 0.5 * static_cast<double>(row);
      const Point along_s = (1 - t) * (point(1) - point(0)) + t * (point(2) - point(3)),
                  along_t = (1 - s) * (point(3) - point(0)) + s * (point(2) - point(1));
      const Flux psi_s = sum_of(1 - t, sum_of(1, psi(1), -1, psi(0)), t, sum_of(1, psi(2), -1, psi(3))),
                 psi_t = sum_of(1 - s, sum_of(1, psi(3), -1, psi(0)), s, sum_of(1, psi(2), -1, psi(1)));
      const State& state = states[3 * row + column];
      const double here = product(psi_s, flux(state, {along_t.y, -along_t.x})) +
                          product(psi_t, flux(state, {-along_s.y, along_s.x}));
      sum += weights[row] * weights[column] * here;
    }
  }
  return sum;
}

/// Sums contributions, each distributed among its nodes: variations from cell to cell cancel there (a
/// partition of unity, Richter and Wick 2015); the absolute value of the rest is used.
class Sums {
 public:
  explicit Sums(const FlowRun& run) : run_{run} { error_.of_nodes.resize(run.mesh.owned_nodes(), 0.0); }

  template <class Nodes>
  void add(double part, const Nodes& nodes) {
    for (const NodeId node : nodes) {
      if (run_.mesh.is_owned(node)) error_.of_nodes[node] += part / static_cast<double>(nodes.size());
    }
  }

  GoalError finish() {
    error_.signed_sum = reproducible_sum(run_.comm, error_.of_nodes);
    for (double& part : error_.of_nodes) part = std::abs(part);
    error_.sum = reproducible_sum(run_.comm, error_.of_nodes);
    return std::move(error_);
  }

 private:
  const FlowRun& run_;
  GoalError error_;
};

/// Adds the pressure on each wall or symmetry plane: in the residual and in the functional.
void add_faces(const FlowRun& run, const GoalFunctional& goal, const IdVector<NodeId, Flux>& adjoint,
               const CellParts& cells, Sums& sums) {
  const auto faces = run.mesh.faces();
  auto part = goal.parts().begin();
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const BoundaryFace& face = faces[f];
    const bool counts = part != goal.parts().end() && part->face == f;
    const GoalFunctional::Part weights = counts ? *part++ : GoalFunctional::Part{};
    const Condition condition = run.model.boundaries[face.boundary].condition;
    if (condition != Condition::wall && condition != Condition::symmetry) continue;
    const auto along = [&](NodeId node) {
      return adjoint[node][1] * face.normal.x + adjoint[node][2] * face.normal.y;
    };
    const double from = along(face.from) - weights.of_from, to = along(face.to) - weights.of_to;
    const State &at_from = run.states[face.from], &at_to = run.states[face.to];
    const double middle = cells.state_between(face.from, face.to)[3];
    const double exact = face.half_size / 3 * (from * at_from[3] + 2 * (from + to) * middle + to * at_to[3]);
    const double scheme = face.half_size * (from * state_at_half(face, at_from, at_to)[3] +
                                            to * state_at_half(face, at_to, at_from)[3]);
    sums.add(exact - scheme, std::array{face.from, face.to});
  }
}

}  // namespace

GoalError goal_error(const FlowRun& run, const GoalFunctional& goal, const IdVector<NodeId, Flux>& adjoint) {
  const CellParts cells(run, adjoint);
  Sums sums(run);
  const HaloMesh& halo = run.mesh.halo();
  halo.for_each_cell([&](const auto& nodes) {
    bool touches = false;
    Point centre{};
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      touches = touches || halo.owns(nodes[i]);
      centre = centre + 1.0 / static_cast<double>(nodes.size()) * halo.point(nodes[i]);
    }
    if (touches) sums.add(cells.by_scheme(nodes, centre) - cells.integral(nodes), nodes);
  });
  add_faces(run, goal, adjoint, cells, sums);
  return sums.finish();
}

}  // namespace quadloop::flow::euler
