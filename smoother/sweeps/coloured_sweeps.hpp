#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "smoother/sweeps/node_stars.hpp"

namespace quadloop {

/// Sweeps over the nodes that may move, colour by colour; a node is visited where something in its star has
/// moved since it was visited last.
class ColouredSweeps {
 public:
  /// `stale` has a flag for each owned node that is to be visited though nothing near it moves, and is kept
  /// true for what may come after. Mesh, stars and flags must outlive it. *Collective.*
  ColouredSweeps(const Communicator& comm, HaloMesh& mesh, const NodeStars& stars, NodeFlags& stale);

  /// Whether the i-th node or one that it shares a cell with has moved since it was last visited.
  bool is_stale(std::size_t i) const { return stale_[stars_.nodes()[i]] != 0; }
  /// Those round which something has moved, other ranks' nodes too, since this was asked last; ascending.
  std::vector<std::int32_t> take_changed();

  /// Asks `place(i)` for a new place, or none, of each stale node for which `is_active(i)`. Returns the
  /// number of nodes moved on this rank. *Collective.*
  template <class IsActive, class Place>
  std::int64_t sweep(const IsActive& is_active, const Place& place) {
    std::int64_t moves = 0;
    for (const auto& nodes : by_colour_) {
      visits_.clear();  // known beforehand: nodes of one colour do not see each other
      for (const std::int32_t i : nodes) {
        if (is_stale(i) && is_active(i)) visits_.push_back(i);
      }
      for (std::size_t k = 0; k < visits_.size(); ++k) {
        stars_.fetch_ahead(visits_, k);
        const std::int32_t i = visits_[k];
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
  void say_moved(NodeId node);

  HaloMesh& mesh_;
  const NodeStars& stars_;
  std::vector<std::vector<std::int32_t>> by_colour_;
  std::vector<std::int32_t> visits_;  ///< of one colour
  NodeFlags& stale_;
  std::vector<char> is_changed_;   ///< a flag for each star: what take_changed() will give
  NodeFlags moved_;                ///< nodes that have moved in this colour
  std::vector<NodeId> own_moves_;  ///< the same, this rank's
};

}  // namespace quadloop
