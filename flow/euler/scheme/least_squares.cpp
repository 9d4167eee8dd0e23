#include "flow/euler/scheme/reconstruction.hpp"

namespace quadloop::flow::euler {

namespace {

/// Inverse square of half the edge length: the factor 4 cancels.
double weight(const DualEdge& edge) { return 1 / dot(edge.half, edge.half); }

}  // namespace

LeastSquares::LeastSquares(const DualMesh& mesh) : mesh_{mesh}, inverse_(mesh.nodes()) {
  for (const DualEdge& edge : mesh.edges()) {
    const Point d = edge.half;
    const double w = weight(edge);
    for (const NodeId node : {edge.low, edge.high}) {
      Symmetric& m = inverse_[node];
      m.xx += w * d.x * d.x;
      m.xy += w * d.x * d.y;
      m.yy += w * d.y * d.y;
    }
  }
  inverse_.resize(mesh.owned_nodes());
  for (Symmetric& m : inverse_) {
    const double determinant = m.xx * m.yy - m.xy * m.xy;
    m = {m.yy / determinant, -m.xy / determinant, m.xx / determinant};
  }
}

void LeastSquares::compute(const IdVector<NodeId, State>& states,
                           IdVector<NodeId, Gradient>& gradients) const {
  for (Gradient& gradient : gradients) gradient = {};
  for (const DualEdge& edge : mesh_.edges()) {
    const double w = 0.5 * weight(edge);
    const State &low = states[edge.low], &high = states[edge.high];
    Gradient &at_low = gradients[edge.low], &at_high = gradients[edge.high];
    for (std::size_t k = 0; k < 4; ++k) {
      const double change = w * (high[k] - low[k]), along_x = change * edge.half.x,
                   along_y = change * edge.half.y;
      at_low.x[k] += along_x;
      at_low.y[k] += along_y;
      at_high.x[k] += along_x;
      at_high.y[k] += along_y;
    }
  }
  for (const NodeId node : inverse_.ids()) {
    const Symmetric& m = inverse_[node];
    Gradient& gradient = gradients[node];
    for (std::size_t k = 0; k < 4; ++k) {
      const double x = gradient.x[k], y = gradient.y[k];
      gradient.x[k] = m.xx * x + m.xy * y;
      gradient.y[k] = m.xy * x + m.yy * y;
    }
  }
}

IdVector<NodeId, Gradient> LeastSquares::solved(const IdVector<NodeId, Gradient>& weights) const {
  IdVector<NodeId, Gradient> result(weights.size());
  for (const NodeId node : inverse_.ids()) {
    const Symmetric& m = inverse_[node];
    for (std::size_t k = 0; k < 4; ++k) {
      const double x = weights[node].x[k], y = weights[node].y[k];
      result[node].x[k] = m.xx * x + m.xy * y;
      result[node].y[k] = m.xy * x + m.yy * y;
    }
  }
  mesh_.exchange().update(result);
  return result;
}

void LeastSquares::add_transposed(const IdVector<NodeId, Gradient>& weights,
                                  IdVector<NodeId, State>& sums) const {
  const IdVector<NodeId, Gradient> of_sums = solved(weights);
  for (const DualEdge& edge : mesh_.edges()) {
    const double w = 0.5 * weight(edge);
    const Gradient &at_low = of_sums[edge.low], &at_high = of_sums[edge.high];
    for (std::size_t k = 0; k < 4; ++k) {
      const double change =
          w * ((at_low.x[k] + at_high.x[k]) * edge.half.x + (at_low.y[k] + at_high.y[k]) * edge.half.y);
      sums[edge.high][k] += change;
      sums[edge.low][k] -= change;
    }
  }
}

}  // namespace quadloop::flow::euler
