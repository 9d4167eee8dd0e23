#include <algorithm>
#include <cmath>

#include "flow/euler/scheme/reconstruction.hpp"

namespace quadloop::flow::euler {

namespace {

constexpr double smallness = 5;  ///< Venkatakrishnan's K

}  // namespace

Limiter::Limiter(const DualMesh& mesh, double reference_length)
    : mesh_{mesh},
      values_(mesh.nodes()),
      changes_(mesh.nodes()),
      factors_(mesh.owned_nodes(), std::array<double, 4>{1, 1, 1, 1}) {
  for (const double area : mesh.areas()) {
    const double h = smallness * std::sqrt(area) / reference_length;
    small_squared_.push_back(h * h * h);
  }
}

void Limiter::apply(const IdVector<NodeId, State>& states, IdVector<NodeId, Gradient>& gradients) {
  if (!frozen_) {
    find_bounds(states);
    find_changes(gradients);
    find_factors(states);
  }
  for (const NodeId node : factors_.ids()) {
    for (std::size_t k = 0; k < 4; ++k) {
      gradients[node].x[k] *= factors_[node][k];
      gradients[node].y[k] *= factors_[node][k];
    }
  }
}

void Limiter::find_bounds(const IdVector<NodeId, State>& states) {
  for (const NodeId node : states.ids()) values_[node] = {states[node], states[node]};
  for (const DualEdge& edge : mesh_.edges()) {
    const NodeId low = edge.low, high = edge.high;
    for (std::size_t k = 0; k < 4; ++k) {
      values_[low].low[k] = std::min(values_[low].low[k], states[high][k]);
      values_[low].high[k] = std::max(values_[low].high[k], states[high][k]);
      values_[high].low[k] = std::min(values_[high].low[k], states[low][k]);
      values_[high].high[k] = std::max(values_[high].high[k], states[low][k]);
    }
  }
}

void Limiter::find_changes(const IdVector<NodeId, Gradient>& gradients) {
  for (Bounds& bounds : changes_) bounds = {};
  for (const DualEdge& edge : mesh_.edges()) {
    const NodeId low = edge.low, high = edge.high;
    for (std::size_t k = 0; k < 4; ++k) {
      const double forth = gradients[low].x[k] * edge.half.x + gradients[low].y[k] * edge.half.y;
      const double back = -(gradients[high].x[k] * edge.half.x + gradients[high].y[k] * edge.half.y);
      changes_[low].low[k] = std::min(changes_[low].low[k], forth);
      changes_[low].high[k] = std::max(changes_[low].high[k], forth);
      changes_[high].low[k] = std::min(changes_[high].low[k], back);
      changes_[high].high[k] = std::max(changes_[high].high[k], back);
    }
  }
}

/// Factors decrease with the change, so the largest change of a node in each direction decides.
void Limiter::find_factors(const IdVector<NodeId, State>& states) {
  for (const NodeId node : factors_.ids()) {
    for (std::size_t k = 0; k < 4; ++k) {
      const double value = states[node][k], small_squared = small_squared_[node];
      factors_[node][k] =
          std::min(limiting_factor(values_[node].high[k] - value, changes_[node].high[k], small_squared),
                   limiting_factor(value - values_[node].low[k], -changes_[node].low[k], small_squared));
      if (is_positive(k))
        factors_[node][k] = std::min(factors_[node][k], keeping_factor(value, changes_[node].low[k]));
    }
  }
}

}  // namespace quadloop::flow::euler
