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
    for (const GlobalNodeId node : copies) numbers_.emplace(node.value(), owned_nodes++);
  }
  explicit NodeTable(Mesh& mesh) : NodeTable(mesh.first_node, mesh.owned_nodes, mesh.points, mesh.copies) {}

  /// The node of a number over all ranks; no node where it is not known here.
  NodeId find(std::int64_t number) const {
    const std::int64_t offset = number - first_;
    if (0 <= offset && offset < owned_) return NodeId{static_cast<std::int32_t>(offset)};
    const auto found = numbers_.find(number);
    return found == numbers_.end() ? NodeId{} : NodeId{found->second};
  }

  /// The same; where it is not known it becomes a copy at that position.
  NodeId local(std::int64_t number, Point point) {
    const NodeId known = find(number);
    if (known.valid()) return known;
    const NodeId added{size32(points_)};
    numbers_.emplace(number, added.value());
    points_.push_back(point);
    copies_.push_back(GlobalNodeId{number});
    return added;
  }

 private:
  std::int64_t first_;
  std::int32_t owned_;
  std::vector<Point>& points_;
  std::vector<GlobalNodeId>& copies_;
  std::unordered_map<std::int64_t, std::int32_t> numbers_;
};

}  // namespace quadloop
