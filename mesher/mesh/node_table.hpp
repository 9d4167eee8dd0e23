#pragma once

#include <unordered_map>

#include "mesher/base/ids.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// From numbers over all ranks to this rank's, and which of those it has: owned nodes first, then copies. It
/// learns of other ranks' nodes as it goes: they are appended to the copies.
class NodeTable {
 public:
  /// The lists must outlive the table, and others leave them alone meanwhile. `points` are those of all
  /// nodes.
  NodeTable(std::int64_t first_node, std::int32_t owned_nodes, std::vector<Point>& points,
            std::vector<GlobalNodeId>& copies)
      : first_{first_node}, owned_{owned_nodes}, points_{points}, copies_{copies} {
    for (const GlobalNodeId node : copies) local_of_.emplace(node, owned_nodes++);
  }
  explicit NodeTable(Mesh& mesh) : NodeTable(mesh.first_node, mesh.owned_nodes, mesh.points, mesh.copies) {}

  /// No node where it is not known here.
  NodeId find(GlobalNodeId node) const {
    const std::int64_t offset = node.value() - first_;
    if (0 <= offset && offset < owned_) return NodeId{static_cast<std::int32_t>(offset)};
    const auto found = local_of_.find(node);
    return found == local_of_.end() ? NodeId{} : found->second;
  }

  /// The same; where it is not known it becomes a copy at that position.
  NodeId local(GlobalNodeId node, Point point) {
    const NodeId known = find(node);
    if (known.valid()) return known;
    const NodeId added{size32(points_)};
    local_of_.emplace(node, added);
    points_.push_back(point);
    copies_.push_back(node);
    return added;
  }

 private:
  std::int64_t first_;
  std::int32_t owned_;
  std::vector<Point>& points_;
  std::vector<GlobalNodeId>& copies_;
  std::unordered_map<GlobalNodeId, NodeId> local_of_;
};

}  // namespace quadloop
