#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/base/communicator.hpp"
#include "mesher/forest/leaf_graph.hpp"

namespace quadloop {

/// Brings to each rank what the owners of its ghost leaves know of them.
class GhostExchange {
 public:
  /// *Collective.*
  GhostExchange(const Communicator& comm, const LeafGraph& graph);

  /// `values` has one entry for each leaf of the graph; those of the ghosts are replaced by their owners'.
  /// *Collective.*
  template <class T>
  void update(std::vector<T>& values) const;

 private:
  const Communicator& comm_;
  const LeafGraph& graph_;
  std::vector<std::vector<std::int32_t>> ghosts_;  ///< of each rank, as leaves of the graph
  std::vector<std::vector<std::int32_t>> asked_;   ///< by each rank, counted from this rank's first leaf
};

template <class T>
void GhostExchange::update(std::vector<T>& values) const {
  std::vector<std::vector<T>> answers(asked_.size());
  for (std::size_t rank = 0; rank < asked_.size(); ++rank) {
    for (const std::int32_t index : asked_[rank])
      answers[rank].push_back(values[static_cast<std::size_t>(graph_.from_local(index))]);
  }
  const auto received = comm_.exchange(answers);
  for (std::size_t rank = 0; rank < received.size(); ++rank) {
    for (std::size_t i = 0; i < received[rank].size(); ++i)
      values[static_cast<std::size_t>(ghosts_[rank][i])] = received[rank][i];
  }
}

/// Calls `visit` for the leaves of the graph that touch a leaf, by an edge or a corner; for some of them more
/// than once. Touching leaves must differ by one level at most.
template <class Visit>
void for_touching_leaves(const LeafGraph& graph, std::int32_t leaf, const Visit& visit) {
  const Quadrant& q = graph.leaf(leaf);
  const std::int64_t last = q.size() - 1, x = q.x, y = q.y;
  const std::array<std::array<std::int64_t, 2>, 12> places{{{x - 1, y - 1},
                                                            {x, y - 1},
                                                            {x + last, y - 1},
                                                            {x + last + 1, y - 1},
                                                            {x + last + 1, y},
                                                            {x + last + 1, y + last},
                                                            {x + last + 1, y + last + 1},
                                                            {x + last, y + last + 1},
                                                            {x, y + last + 1},
                                                            {x - 1, y + last + 1},
                                                            {x - 1, y + last},
                                                            {x - 1, y}}};
  for (const auto& [px, py] : places) {
    const std::int32_t other = graph.leaf_at(px, py);
    if (other != LeafGraph::none) visit(other);
  }
}

}  // namespace quadloop
