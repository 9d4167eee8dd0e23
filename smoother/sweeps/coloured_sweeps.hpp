#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "mesher/mesh/colouring.hpp"
#include "smoother/sweeps/node_stars.hpp"

namespace quadloop::smoother {

/// Sweeps over the movable nodes, colour by colour. A node is visited if something in its star has moved
/// since its last visit.
class ColouredSweeps {
 public:
  /// `stale`: a flag for each node. On entry it marks the owned nodes to be visited even if nothing near them
  /// moves; it is kept up to date for later sweeps. Mesh, stars and flags must outlive it. *Collective.*
  ColouredSweeps(const Communicator& comm, HaloMesh& mesh, const NodeStars& stars, NodeFlags& stale);

  /// Whether the i-th node or a node that shares a cell with it has moved since its last visit.
  bool is_stale(std::size_t i) const { return stale_[stars_.nodes()[i]] != 0; }
  /// The nodes that have moved, or share a cell with one that has (on any rank), since the last call;
  /// ascending.
  std::vector<std::int32_t> take_changed();

  /// Calls `place(i)`, which returns a new position or none, for each node with `is_active(i)`: the stale
  /// ones among `stars`, and those that become stale before their colour's turn. Returns the number of nodes
  /// moved on this rank. `fetch_ahead(order, k)` is called before `place(order[k])`, like
  /// NodeStars::fetch_corners_ahead. *Collective.*
  template <class IsActive, class Place, class FetchAhead = NothingToFetch>
  std::int64_t sweep(std::span<const std::int32_t> stars, const IsActive& is_active, const Place& place,
                     const FetchAhead& fetch_ahead = {}) {
    std::int64_t moves = 0;
    for (auto& visits : by_colour_) visits.clear();
    for (const std::int32_t i : stars) {
      if (is_stale(i) && is_active(i)) visits_of(i).push_back(i);
    }
    for (colour_ = 0; colour_ < colouring_.count; ++colour_) {
      const auto& visits = by_colour_[colour_];
      for (std::size_t k = 0; k < visits.size(); ++k) {
        stars_.fetch_corners_ahead(visits, k);
        stars_.fetch_points_ahead(visits, k);
        fetch_ahead(visits, k);
        const std::int32_t i = visits[k];
        stale_[stars_.nodes()[i]] = 0;
        const std::optional<Point> to = place(i);
        if (!to) continue;
        move(i, *to);
        ++moves;
      }
      share_moves();
      for (const std::int32_t i : woken_) {
        if (is_active(i)) visits_of(i).push_back(i);
      }
      woken_.clear();
    }
    return moves;
  }

 private:
  std::vector<std::int32_t>& visits_of(std::size_t i) {
    return by_colour_[colouring_.colour_of[stars_.nodes()[i]]];
  }
  void move(std::size_t i, Point to);
  void share_moves();
  void look_again(NodeId node);

  HaloMesh& mesh_;
  const NodeStars& stars_;
  NodeFlags& stale_;
  Colouring colouring_;
  std::vector<std::vector<std::int32_t>> by_colour_;  ///< nodes to be visited, for each colour
  std::int8_t colour_ = 0;                            ///< colour being visited
  NodeFlags changed_;                                 ///< nodes that take_changed() will return
  std::vector<std::int32_t> woken_;                   ///< nodes of later colours that have become stale
  NodeFlags moved_;                ///< flags of this rank's nodes that have moved in this colour
  std::vector<NodeId> own_moves_;  ///< list of these nodes
};

}  // namespace quadloop::smoother
