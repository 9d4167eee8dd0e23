#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/mesh/halo_mesh.hpp"
#include "smoother/objective/star.hpp"

namespace quadloop {

/// The stars of those owned nodes that may move.
class NodeStars {
 public:
  /// `free_nodes` ascend. `targets` has an entry for each cell of the halo mesh, or none at all.
  NodeStars(const HaloMesh& mesh, std::vector<NodeId> free_nodes, const std::vector<CellTarget>& targets);

  const std::vector<NodeId>& nodes() const { return nodes_; }
  std::size_t size() const { return nodes_.size(); }

  /// The star of the i-th free node, with the nodes where they are now.
  void gather(std::size_t i, Star& star) const;

  /// Calls `visit(node)` for the nodes that share a cell with the i-th free node, for some more than once.
  template <class Visit>
  void for_each_neighbour(std::size_t i, const Visit& visit) const {
    for (const Corner& c : corners_of(i)) {
      visit(c.q);
      visit(c.r);
    }
  }

 private:
  struct Corner {
    NodeId q, r;
    std::int32_t target = 0;  ///< in targets_
    CellAngle angle = CellAngle::all;
  };
  std::span<const Corner> corners_of(std::size_t i) const {
    return std::span(corners_).subspan(starts_[i], starts_[i + 1] - starts_[i]);
  }
  template <std::size_t width>
  void add_cell(const std::array<NodeId, width>& cell, const CellTarget& target,
                const IdVector<NodeId, std::int32_t>& star_of, std::vector<std::size_t>& ends);
  template <std::size_t width>
  std::int32_t first_target(const CellTarget& target);

  const HaloMesh& mesh_;
  std::vector<NodeId> nodes_;
  std::vector<std::size_t> starts_;
  std::vector<Corner> corners_;
  std::vector<CornerTarget> targets_;
};

}  // namespace quadloop
