#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "smoother/sweeps/node_stars.hpp"

namespace quadloop {

/// For visits that need little beside the star.
struct NothingToFetch {
  void operator()(std::span<const std::int32_t> /*order*/, std::size_t /*k*/) const {}
};

/// Sweeps over the nodes that may move, colour by colour; a node is visited where something in its star has
/// moved since it was visited last.
class ColouredSweeps {
 public:
  /// `stale` has a flag for each node, of those that this rank owns for what is to be visited though nothing
  /// near it moves, and is kept true for what may come after. Mesh, stars and flags must outlive it.
  /// *Collective.*
  ColouredSweeps(const Communicator& comm, HaloMesh& mesh, const NodeStars& stars, NodeFlags& stale);

  /// Whether the i-th node or one that it shares a cell with has moved since it was last visited.
  bool is_stale(std::size_t i) const { return stale_[stars_.nodes()[i]] != 0; }
  /// Whether one of these, other ranks' nodes too, has moved since this was asked last.
  bool take_changed(std::size_t i) { return std::exchange(changed_[stars_.nodes()[i]], 0) != 0; }

  /// Asks `place(i)` for a new place, or none, of each stale node for which `is_active(i)`. Returns the
  /// number of nodes moved on this rank. `fetch_ahead(order, k)` comes before `place(order[k])`, as
  /// NodeStars::fetch_ahead. *Collective.*
  template <class IsActive, class Place, class FetchAhead = NothingToFetch>
  std::int64_t sweep(const IsActive& is_active, const Place& place, const FetchAhead& fetch_ahead = {}) {
    std::int64_t moves = 0;
    for (auto& visits : by_colour_) visits.clear();
    for (std::int32_t i = 0; i < std::ssize(stars_); ++i) {
      if (is_active(i)) by_colour_[colours_[i]].push_back(i);
    }
    for (auto& visits : by_colour_) {  // known beforehand: nodes of one colour do not see each other
      std::erase_if(visits, [&](std::int32_t i) { return !is_stale(i); });
      for (std::size_t k = 0; k < visits.size(); ++k) {
        stars_.fetch_ahead(visits, k);
        fetch_ahead(visits, k);
        const std::int32_t i = visits[k];
        stale_[stars_.nodes()[i]] = 0;
        const std::optional<Point> to = place(i);
        if (!to) continue;
        move(i, *to);
        ++moves;
      }
      share_moves();
    }
    return moves;
  }

 private:
  void move(std::size_t i, Point to);
  void share_moves();
  void look_again(NodeId node) { stale_[node] = changed_[node] = 1; }

  HaloMesh& mesh_;
  const NodeStars& stars_;
  std::vector<std::int8_t> colours_;                  ///< of each star
  std::vector<std::vector<std::int32_t>> by_colour_;  ///< those to be visited
  NodeFlags& stale_;
  NodeFlags changed_;              ///< what take_changed() will give
  NodeFlags moved_;                ///< this rank's nodes that have moved in this colour
  std::vector<NodeId> own_moves_;  ///< the same
};

}  // namespace quadloop
