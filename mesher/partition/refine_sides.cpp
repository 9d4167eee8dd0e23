#include "mesher/partition/refine_sides.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <queue>
#include <span>
#include <tuple>

namespace quadloop {

namespace {

constexpr int most_passes = 8;
constexpr std::int32_t coarsest = 40;      // nodes
constexpr std::int64_t most_tries = 2000;  // consecutive moves without improvement

std::span<const WeightedGraph::Neighbour> neighbours_of(const WeightedGraph& graph, std::int32_t node) {
  return std::span(graph.neighbours).subspan(graph.starts[node], graph.starts[node + 1] - graph.starts[node]);
}

/// One pass, in which each node moves at most once.
class Pass {
 public:
  Pass(WeightedGraph& graph, SideWeights& weights)
      : graph_{graph}, weights_{weights}, gains_(graph.size()), has_moved_(graph.size(), 0) {
    for (std::int32_t node = 0; node < graph.size(); ++node) {
      gains_[node] = gain_of(node);
      if (is_beside_other(node)) push(node);
    }
  }

  /// Returns whether the pass improved anything.
  bool run() {
    State best{0, imbalance()}, now = best;
    std::size_t best_moves = 0;
    for (;;) {
      const std::int32_t node = next();
      if (node < 0) break;
      now.cut -= gains_[node];
      move(node);
      now.imbalance = imbalance();
      if (now < best) {
        best = now;
        best_moves = moved_.size();
      }
      if (std::ssize(moved_) - static_cast<std::int64_t>(best_moves) > most_tries) break;
    }
    while (moved_.size() > best_moves) {
      change_side(moved_.back());
      moved_.pop_back();
    }
    return best_moves > 0;
  }

 private:
  struct State {
    std::int64_t cut, imbalance;
    friend auto operator<=>(const State&, const State&) = default;
  };
  /// Order: largest gain first; for equal gains the latest entry first, so that moves continue locally.
  struct Entry {
    std::int64_t gain, time;
    std::int32_t node;
    friend bool operator<(const Entry& a, const Entry& b) {
      return std::tuple(a.gain, a.time) < std::tuple(b.gain, b.time);
    }
  };

  std::int64_t gain_of(std::int32_t node) const {
    const int own = graph_.sides[node];
    std::int64_t gain = graph_.fixed[node][1 - own] - graph_.fixed[node][own];
    for (const auto& [other, weight] : neighbours_of(graph_, node))
      gain += graph_.sides[other] == own ? -weight : weight;
    return gain;
  }
  bool is_beside_other(std::int32_t node) const {
    const int own = graph_.sides[node];
    return graph_.fixed[node][1 - own] > 0 ||
           std::ranges::any_of(neighbours_of(graph_, node),
                               [&](const auto& neighbour) { return graph_.sides[neighbour.node] != own; });
  }
  std::int64_t imbalance() const { return std::abs(weights_.sides[0] - weights_.sides[1]); }

  void push(std::int32_t node) { queues_[graph_.sides[node]].push({gains_[node], time_++, node}); }

  /// Returns the best movable node of either side; -1: none.
  std::int32_t next() {
    std::int32_t best = -1;
    int from = -1;
    for (const int side : {0, 1}) {
      auto& queue = queues_[side];
      while (!queue.empty() && !is_current(queue.top())) queue.pop();
      if (queue.empty()) continue;
      const std::int32_t node = queue.top().node;
      const std::int64_t weight = graph_.weights[node];
      if (weights_.sides[side] - weight < weights_.least || weights_.sides[1 - side] + weight > weights_.most)
        continue;
      const bool heavier = weights_.sides[side] > weights_.sides[1 - side];
      if (best >= 0 && (gains_[node] < gains_[best] || (gains_[node] == gains_[best] && !heavier))) continue;
      best = node;
      from = side;
    }
    if (best >= 0) queues_[from].pop();
    return best;
  }
  bool is_current(const Entry& entry) const {
    return has_moved_[entry.node] == 0 && entry.gain == gains_[entry.node];
  }

  void change_side(std::int32_t node) {
    const int from = graph_.sides[node];
    weights_.sides[from] -= graph_.weights[node];
    weights_.sides[1 - from] += graph_.weights[node];
    graph_.sides[node] = static_cast<char>(1 - from);
  }

  void move(std::int32_t node) {
    change_side(node);
    has_moved_[node] = 1;
    moved_.push_back(node);
    for (const auto& neighbour : neighbours_of(graph_, node)) {
      if (has_moved_[neighbour.node] != 0) continue;
      gains_[neighbour.node] = gain_of(neighbour.node);
      push(neighbour.node);
    }
  }

  WeightedGraph& graph_;
  SideWeights& weights_;
  std::vector<std::int64_t> gains_;
  std::vector<char> has_moved_;
  std::vector<std::int32_t> moved_;
  std::array<std::priority_queue<Entry>, 2> queues_;
  std::int64_t time_ = 0;
};

/// Maps each node to the coarser graph: pairs on the same side along the heaviest edges.
class Matching {
 public:
  explicit Matching(const WeightedGraph& graph) : coarse(graph.size(), -1) {
    const std::int64_t heaviest =
        std::max<std::int64_t>(8, std::reduce(graph.weights.begin(), graph.weights.end()) / coarsest);
    for (const std::int32_t node : order_of(graph)) {
      if (coarse[node] >= 0) continue;
      const std::int32_t partner = partner_of(graph, node, heaviest);
      coarse[node] = count;
      if (partner >= 0) coarse[partner] = count;
      ++count;
    }
  }

  std::vector<std::int32_t> coarse;
  std::int32_t count = 0;

 private:
  /// Pseudo-random order, so that pairs do not align.
  static std::vector<std::int32_t> order_of(const WeightedGraph& graph) {
    std::vector<std::int32_t> order(graph.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, [](std::int32_t node) {
      return std::pair(static_cast<std::uint32_t>(node) * 2654435761U, node);
    });
    return order;
  }

  std::int32_t partner_of(const WeightedGraph& graph, std::int32_t node, std::int64_t heaviest) const {
    std::int32_t best = -1;
    std::tuple<std::int32_t, std::int64_t> best_rank;
    for (const auto& [other, weight] : neighbours_of(graph, node)) {
      if (other == node || coarse[other] >= 0 || graph.sides[other] != graph.sides[node] ||
          graph.weights[other] + graph.weights[node] > heaviest)
        continue;
      const std::tuple rank(-weight, graph.weights[other]);
      if (best < 0 || rank < best_rank) {
        best = other;
        best_rank = rank;
      }
    }
    return best;
  }
};

WeightedGraph coarser(const WeightedGraph& fine, const Matching& matching) {
  WeightedGraph coarse;
  coarse.weights.assign(matching.count, 0);
  coarse.sides.assign(matching.count, 0);
  coarse.fixed.assign(matching.count, {0, 0});
  std::vector<std::array<std::int32_t, 2>> members(matching.count, {-1, -1});
  for (std::int32_t node = 0; node < fine.size(); ++node) {
    const std::int32_t to = matching.coarse[node];
    coarse.weights[to] += fine.weights[node];
    coarse.sides[to] = fine.sides[node];
    for (const int side : {0, 1}) coarse.fixed[to][side] += fine.fixed[node][side];
    members[to][members[to][0] < 0 ? 0 : 1] = node;
  }
  std::vector<std::int64_t> slot(matching.count, -1);  // index of a neighbour among those of the current node
  for (std::int32_t to = 0; to < matching.count; ++to) {
    const std::int64_t start = std::ssize(coarse.neighbours);
    coarse.starts.push_back(start);
    for (const std::int32_t node : members[to]) {
      if (node < 0) continue;
      for (const auto& [other, weight] : neighbours_of(fine, node)) {
        const std::int32_t across = matching.coarse[other];
        if (across == to) continue;
        if (slot[across] < start) {
          slot[across] = std::ssize(coarse.neighbours);
          coarse.neighbours.push_back({across, 0});
        }
        coarse.neighbours[slot[across]].weight += weight;
      }
    }
  }
  coarse.starts.push_back(std::ssize(coarse.neighbours));
  return coarse;
}

}  // namespace

void refine_sides(WeightedGraph& graph, SideWeights& weights) {
  if (graph.size() > coarsest) {
    const Matching matching(graph);
    if (10 * std::int64_t{matching.count} < 9 * std::int64_t{graph.size()}) {
      WeightedGraph coarse = coarser(graph, matching);
      refine_sides(coarse, weights);
      for (std::int32_t node = 0; node < graph.size(); ++node)
        graph.sides[node] = coarse.sides[matching.coarse[node]];
    }
  }
  for (int pass = 0; pass < most_passes && Pass(graph, weights).run(); ++pass) {
  }
}

}  // namespace quadloop
