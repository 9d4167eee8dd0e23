#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/mesh/halo_mesh.hpp"
#include "smoother/objective/star.hpp"

namespace quadloop::smoother {

/// The stars of the owned nodes that may move.
class NodeStars {
 public:
  /// `free_nodes` ascend. `targets` has an entry for each cell of the halo mesh, or is empty.
  NodeStars(const HaloMesh& mesh, std::vector<NodeId> free_nodes, const std::vector<CellTarget>& targets);

  const std::vector<NodeId>& nodes() const { return nodes_; }
  std::size_t size() const { return nodes_.size(); }
  /// The indices of all stars: 0, 1, ...
  std::vector<std::int32_t> all() const;
  /// Index of a node among the free nodes; -1 if it is not free.
  std::int32_t star_of(NodeId node) const { return star_of_[node]; }

  /// The star of the i-th free node at the present node positions.
  void gather(std::size_t i, Star& star) const;
  /// Prefetches what for_each_neighbour() needs for the stars shortly after `order[k]`.
  void fetch_corners_ahead(std::span<const std::int32_t> order, std::size_t k) const;
  /// Same for what gather() needs in addition.
  void fetch_points_ahead(std::span<const std::int32_t> order, std::size_t k) const;
  /// Whether a corner in the star of the i-th free node costs more than `limit` < 1 (Eq. 3.2).
  bool costs_more(std::size_t i, double limit) const;

  /// Calls `visit(node)` for the nodes that share a cell with the i-th free node, for some more than once.
  /// The node's cells form one fan.
  template <class Visit>
  void for_each_neighbour(std::size_t i, const Visit& visit) const {
    std::int64_t open = 0;  // difference of the first and the last neighbour of a fan of triangles; 0: closed
    for (const Corner& c : corners_of(i)) {
      visit(c.q);
      open += std::int64_t{c.q.value()} - c.r.value();
    }
    if (open == 0 && seen_of_.empty()) return;  // each neighbour is the first one of some triangle
    for (const Corner& c : corners_of(i)) visit(c.r);
  }
  /// Calls `visit(i)` for the free nodes that share a cell with a ghost node, as often as
  /// for_each_neighbour(i) visits that node.
  template <class Visit>
  void for_each_star_round(NodeId copy, const Visit& visit) const;

 private:
  struct Corner {
    NodeId q, r;
  };
  /// The target of a corner as seen from a node of its cell.
  struct SeenTarget {
    CornerTarget target;
    CellAngle angle = CellAngle::all;
  };
  std::span<const Corner> corners_of(std::size_t i) const {
    return std::span(corners_).subspan(starts_[i], starts_[i + 1] - starts_[i]);
  }
  /// The target of the k-th of all corners.
  const SeenTarget& seen(std::size_t k) const { return seen_[seen_of_.empty() ? 0 : seen_of_[k]]; }
  void number_stars();
  struct Touched {
    std::vector<char> cells;                ///< flags the cells that have a free node
    std::vector<std::int32_t> near_ghosts;  ///< stars that share a cell with a ghost node, ascending
  };
  Touched find_starts();
  template <std::size_t width>
  void add_cell(const std::array<NodeId, width>& cell, const CellTarget& target);
  template <std::size_t width>
  std::int32_t first_seen(const CellTarget& target);
  template <std::size_t width>
  static std::vector<SeenTarget> seen_targets(const std::array<CornerTarget, width>& of_corners);
  void list_stars_round_ghosts(const std::vector<std::int32_t>& near_ghosts);

  const HaloMesh& mesh_;
  std::vector<NodeId> nodes_;
  IdVector<NodeId, std::int32_t> star_of_;
  std::vector<std::size_t> starts_;
  std::vector<Corner> corners_;
  std::vector<SeenTarget> seen_;
  std::vector<std::int32_t> seen_of_;      ///< index in seen_ for each corner; empty if all are the first
  std::vector<std::size_t> ghost_starts_;  ///< start in ghost_stars_ for each ghost node
  std::vector<std::int32_t> ghost_stars_;  ///< stars that have the ghost node among their neighbours
};

template <class Visit>
void NodeStars::for_each_star_round(NodeId copy, const Visit& visit) const {
  const std::size_t slot = copy.value() - mesh_.owned_nodes();
  for (std::size_t k = ghost_starts_[slot]; k < ghost_starts_[slot + 1]; ++k) visit(ghost_stars_[k]);
}

}  // namespace quadloop::smoother
