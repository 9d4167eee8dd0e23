#pragma once

#include <unordered_map>

#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// A mesh's list of nodes, which learns of other ranks' nodes as it goes: they are appended to its copies.
class NodeTable {
 public:
  /// The mesh must outlive the table, and others leave its nodes alone meanwhile.
  explicit NodeTable(Mesh& mesh) : mesh_{mesh} {
    for (std::size_t i = 0; i < mesh.copies.size(); ++i)
      copies_.emplace(mesh.copies[i].value(), mesh.owned_nodes + static_cast<std::int32_t>(i));
  }

  /// The node of a number over all ranks; a new copy gets the position.
  NodeId local(std::int64_t number, Point point) {
    const std::int64_t offset = number - mesh_.first_node;
    if (0 <= offset && offset < mesh_.owned_nodes) return NodeId{static_cast<std::int32_t>(offset)};
    const auto [found, added] = copies_.emplace(number, static_cast<std::int32_t>(mesh_.points.size()));
    if (added) {
      mesh_.points.push_back(point);
      mesh_.copies.push_back(GlobalNodeId{number});
    }
    return NodeId{found->second};
  }

 private:
  Mesh& mesh_;
  std::unordered_map<std::int64_t, std::int32_t> copies_;
};

}  // namespace quadloop
