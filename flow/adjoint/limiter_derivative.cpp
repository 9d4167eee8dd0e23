#include "flow/adjoint/limiter_derivative.hpp"

#include <utility>

#include "flow/euler/model/dual_number.hpp"

namespace quadloop::flow::euler {

/// For one side (up or down) of a node: the first edge, for each variable, with the extreme value and the
/// extreme change.
struct LimiterDerivative::Side {
  std::array<NodeId, 4> neighbour{}, along{};
  std::array<Point, 4> way{};
};

LimiterDerivative::LimiterDerivative(const DualMesh& mesh, const Limiter& limiter,
                                     const IdVector<NodeId, State>& states,
                                     IdVector<NodeId, Gradient> gradients)
    : mesh_{mesh}, gradients_{std::move(gradients)}, parts_(mesh.owned_nodes()), live_{!limiter.frozen()} {
  for (const NodeId node : parts_.ids()) {
    for (std::size_t k = 0; k < 4; ++k) parts_[node][k].factor = limiter.factors()[node][k];
    small_squared_.push_back(limiter.small_squared(node));
  }
  if (live_) find(limiter, states);
}

/// The sides of a node are up and down, in this order.
void LimiterDerivative::find_edges(const Limiter& limiter, const IdVector<NodeId, State>& states,
                                   IdVector<NodeId, std::array<Side, 2>>& sides) const {
  for (const DualEdge& edge : mesh_.edges()) {
    for (const auto& [node, other, way] :
         {std::tuple{edge.low, edge.high, edge.half}, {edge.high, edge.low, -1.0 * edge.half}}) {
      if (!mesh_.is_owned(node)) continue;
      const Gradient& gradient = gradients_[node];
      for (std::size_t k = 0; k < 4; ++k) {
        const double change = gradient.x[k] * way.x + gradient.y[k] * way.y;
        for (const bool up : {true, false}) {
          Side& side = sides[node][up ? 0 : 1];
          const auto& of = [&](const Limiter::Bounds& bounds) { return up ? bounds.high[k] : bounds.low[k]; };
          if (!side.neighbour[k].valid() && states[other][k] == of(limiter.values(node)))
            side.neighbour[k] = other;
          if (side.along[k].valid() || change != of(limiter.changes(node))) continue;
          side.along[k] = other;
          side.way[k] = way;
        }
      }
    }
  }
}

void LimiterDerivative::find(const Limiter& limiter, const IdVector<NodeId, State>& states) {
  IdVector<NodeId, std::array<Side, 2>> sides(parts_.size());
  find_edges(limiter, states, sides);
  for (const NodeId node : parts_.ids()) {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& [up, down] = sides[node];
      follow_bounds(limiter, node, k, states[node][k], up, down);
      if (is_positive(k)) follow_keeping(limiter, node, k, states[node][k], down);
    }
  }
}

/// For factors determined by the bounds of the neighbours' values.
void LimiterDerivative::follow_bounds(const Limiter& limiter, NodeId node, std::size_t k, double value,
                                      const Side& up_side, const Side& down_side) {
  using Dual = DualNumber<3>;
  const Limiter::Bounds &values = limiter.values(node), &changes = limiter.changes(node);
  const Dual small = Dual::variable(small_squared_[node], 2);
  const Dual up = limiting_factor(Dual::variable(values.high[k] - value, 0),
                                  Dual::variable(changes.high[k], 1), small),
             down = limiting_factor(Dual::variable(value - values.low[k], 0),
                                    Dual::variable(-changes.low[k], 1), small);
  const bool is_up = !(down < up);
  const Side& side = is_up ? up_side : down_side;
  const Dual& decides = is_up ? up : down;
  const double sign = is_up ? 1 : -1;
  Part& part = parts_[node][k];
  part.by_allowed = sign * decides.slopes[0];
  part.by_change = sign * decides.slopes[1];
  part.by_small = decides.slopes[2];
  part.along = side.along[k];
  part.way = side.way[k];
  // a node that has the largest value itself allows no change, whatever the states
  part.neighbour = value == (is_up ? values.high[k] : values.low[k]) ? NodeId{} : side.neighbour[k];
  if (!part.neighbour.valid()) part.by_allowed = 0;
}

/// For factors determined by the least remaining density or pressure.
void LimiterDerivative::follow_keeping(const Limiter& limiter, NodeId node, std::size_t k, double value,
                                       const Side& down) {
  using Dual = DualNumber<2>;
  const Dual keeping =
      keeping_factor(Dual::variable(value, 0), Dual::variable(limiter.changes(node).low[k], 1));
  Part& part = parts_[node][k];
  if (keeping.value >= 1 || keeping.value != part.factor) return;
  part.by_allowed = part.by_small = 0;
  part.neighbour = NodeId{};
  part.by_own = keeping.slopes[0];
  part.by_change = keeping.slopes[1];
  part.along = down.along[k];
  part.way = down.way[k];
}

void LimiterDerivative::apply(const IdVector<NodeId, State>& change,
                              IdVector<NodeId, Gradient>& gradients) const {
  for (const NodeId node : parts_.ids()) {
    const Gradient& held = gradients_[node];
    Gradient& gradient = gradients[node];
    for (std::size_t k = 0; k < 4; ++k) {
      const Part& part = parts_[node][k];
      double factor = part.by_change * (gradient.x[k] * part.way.x + gradient.y[k] * part.way.y);
      factor += part.by_own * change[node][k];
      if (part.by_allowed != 0) factor += part.by_allowed * (change[part.neighbour][k] - change[node][k]);
      gradient.x[k] = part.factor * gradient.x[k] + factor * held.x[k];
      gradient.y[k] = part.factor * gradient.y[k] + factor * held.y[k];
    }
  }
}

namespace {

/// Contributions of a node's factors to the neighbours that determine them.
struct HandedFactors {
  std::array<GlobalNodeId, 4> to;
  State weight{};
};

}  // namespace

void LimiterDerivative::apply_transposed(IdVector<NodeId, Gradient>& weights,
                                         IdVector<NodeId, State>& sums) const {
  IdVector<NodeId, HandedFactors> handed(live_ ? mesh_.nodes() : 0);
  for (const NodeId node : parts_.ids()) {
    const Gradient& held = gradients_[node];
    Gradient& weight = weights[node];
    for (std::size_t k = 0; k < 4; ++k) {
      const Part& part = parts_[node][k];
      const double factor = held.x[k] * weight.x[k] + held.y[k] * weight.y[k];
      weight.x[k] = part.factor * weight.x[k] + part.by_change * factor * part.way.x;
      weight.y[k] = part.factor * weight.y[k] + part.by_change * factor * part.way.y;
      sums[node][k] += part.by_own * factor;
      if (part.by_allowed == 0) continue;
      sums[node][k] -= part.by_allowed * factor;
      handed[node].to[k] = mesh_.global(part.neighbour);
      handed[node].weight[k] = part.by_allowed * factor;
    }
  }
  if (!live_) return;
  mesh_.exchange().update(handed);
  for (const DualEdge& edge : mesh_.edges()) {
    for (const auto& [from, to] : {std::pair{edge.low, edge.high}, {edge.high, edge.low}}) {
      if (!mesh_.is_owned(to)) continue;
      const GlobalNodeId name = mesh_.global(to);
      for (std::size_t k = 0; k < 4; ++k) {
        if (handed[from].to[k] == name) sums[to][k] += handed[from].weight[k];
      }
    }
  }
}

namespace {

struct HandedGradient {
  std::array<GlobalNodeId, 4> to;
  std::array<Point, 4> weight{};
};

}  // namespace

void LimiterDerivative::add_place_weights(const IdVector<NodeId, Gradient>& weights,
                                          IdVector<NodeId, Point>& places,
                                          IdVector<NodeId, double>& areas) const {
  if (!live_) return;
  IdVector<NodeId, HandedGradient> handed(mesh_.nodes());
  for (const NodeId node : parts_.ids()) {
    const Gradient &held = gradients_[node], &weight = weights[node];
    for (std::size_t k = 0; k < 4; ++k) {
      const Part& part = parts_[node][k];
      const double factor = held.x[k] * weight.x[k] + held.y[k] * weight.y[k];
      // (K h)^3 is proportional to area^(3/2)
      areas[node] += factor * part.by_small * 1.5 * small_squared_[node] / mesh_.areas()[node];
      if (part.by_change == 0 || !part.along.valid()) continue;
      const Point half = 0.5 * factor * part.by_change * Point{held.x[k], held.y[k]};
      places[node] = places[node] - half;
      handed[node].to[k] = mesh_.global(part.along);
      handed[node].weight[k] = half;
    }
  }
  mesh_.exchange().update(handed);
  for (const DualEdge& edge : mesh_.edges()) {
    for (const auto& [from, to] : {std::pair{edge.low, edge.high}, {edge.high, edge.low}}) {
      if (!mesh_.is_owned(to)) continue;
      const GlobalNodeId name = mesh_.global(to);
      for (std::size_t k = 0; k < 4; ++k) {
        if (handed[from].to[k] == name) places[to] = places[to] + handed[from].weight[k];
      }
    }
  }
}

}  // namespace quadloop::flow::euler
