#pragma once

#include <unordered_map>

#include "mesher/base/ids.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Maps global to local node numbers of this rank: owned nodes first, then ghosts. New nodes of other ranks
/// can be appended to the ghosts.
class NodeTable {
 public:
  /// `points` contains the positions of all nodes of this rank. The vectors must outlive the table; only the
  /// table may change them.
  NodeTable(std::int64_t first_node, std::int32_t owned_nodes, std::vector<Point>& points,
            std::vector<GlobalNodeId>& ghosts)
      : first_{first_node}, owned_{owned_nodes}, points_{points}, ghosts_{ghosts} {
    for (const GlobalNodeId node : ghosts) local_of_.emplace(node, owned_nodes++);
  }
  explicit NodeTable(Mesh& mesh) : NodeTable(mesh.first_node, mesh.owned_nodes, mesh.points, mesh.ghosts) {}

  /// Returns the local number; invalid if the node is not on this rank.
  NodeId find(GlobalNodeId node) const {
    const std::int64_t offset = node.value() - first_;
    if (0 <= offset && offset < owned_) return NodeId{static_cast<std::int32_t>(offset)};
    const auto found = local_of_.find(node);
    return found == local_of_.end() ? NodeId{} : found->second;
  }

  /// Returns the local number. A node that is not yet on this rank is appended to the ghosts, with this
  /// position. Ghosts are few compared with the owned nodes, so that room is added in small steps.
  NodeId local(GlobalNodeId node, Point point) {
    const NodeId known = find(node);
    if (known.valid()) return known;
    const NodeId added{size32(points_)};
    local_of_.emplace(node, added);
    if (points_.size() == points_.capacity()) points_.reserve(points_.size() + points_.size() / 16 + 64);
    points_.push_back(point);
    ghosts_.push_back(node);
    return added;
  }

 private:
  std::int64_t first_;
  std::int32_t owned_;
  std::vector<Point>& points_;
  std::vector<GlobalNodeId>& ghosts_;
  std::unordered_map<GlobalNodeId, NodeId> local_of_;
};

}  // namespace quadloop
