#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop {

/// Finds the two cells at each edge that touches a selected owned node, each represented by a Value of the
/// caller, e.g. its number or area. Linear in the number of cells. Memory is needed for the edges whose
/// second cell has not been visited yet: few, if cells follow each other in space.
template <class Value>
class CellPairs {
 public:
  /// `is_wanted(node)` selects owned nodes.
  template <class IsWanted>
  CellPairs(const HaloMesh& mesh, const IsWanted& is_wanted)
      : mesh_{mesh}, last_(mesh.points().size(), unwanted) {
    for (std::int32_t i = 0; i < mesh.owned_nodes(); ++i) {
      if (is_wanted(NodeId{i})) last_[NodeId{i}] = none;
    }
  }

  /// Calls `value_of(nodes, number)` for the cells at selected nodes, numbered as HaloMesh::for_each_cell()
  /// visits them, and `visit(from, to, first, second)` once for each interior edge. Of an edge between owned
  /// nodes both must be selected. An edge between ranks is visited on each rank that owns one of its nodes.
  template <class ValueOf, class Visit>
  void for_each(const ValueOf& value_of, const Visit& visit) {
    std::int32_t number = 0;
    mesh_.for_each_cell([&](const auto& nodes) {
      const bool wanted = std::ranges::any_of(nodes, [&](NodeId node) { return last_[node] != unwanted; });
      if (wanted) add_cell(nodes, value_of(nodes, number), visit);
      ++number;
    });
  }

  /// After for_each(): calls `visit(from, to, value)` for each edge with one cell. If all nodes are selected,
  /// these are the boundary edges.
  template <class Visit>
  void for_each_single(const Visit& visit) const {
    for (std::int32_t i = 0; i < mesh_.owned_nodes(); ++i) {
      for (std::int32_t s = last_[NodeId{i}]; s >= 0; s = sides_[s].next)
        visit(NodeId{i}, sides_[s].other, sides_[s].value);
    }
  }

 private:
  static constexpr std::int32_t none = -1, unwanted = -2;
  /// An edge, and the first cell found at it, until the second one is found.
  struct Side {
    NodeId other;
    std::int32_t next;  ///< next side of the same node, or next free place
    Value value;
  };

  template <std::size_t width, class Visit>
  void add_cell(const std::array<NodeId, width>& nodes, const Value& value, const Visit& visit) {
    for (std::size_t k = 0; k < width; ++k) {
      const NodeId node = nodes[k];
      if (last_[node] == unwanted) continue;
      for (const NodeId other : {nodes[(k + 1) % width], nodes[(k + width - 1) % width]}) {
        const bool counts = !mesh_.owns(other) || (node < other && last_[other] != unwanted);
        if (counts) add_side(node, other, value, visit);
      }
    }
  }

  template <class Visit>
  void add_side(NodeId node, NodeId other, const Value& value, const Visit& visit) {
    for (std::int32_t* link = &last_[node]; *link != none; link = &sides_[*link].next) {
      Side& side = sides_[*link];
      if (side.other != other) continue;
      visit(node, other, side.value, value);
      free_ = std::exchange(*link, std::exchange(side.next, free_));
      return;
    }
    const Side side{other, last_[node], value};
    if (free_ == none) {
      last_[node] = size32(sides_);
      sides_.push_back(side);
    } else {
      last_[node] = free_;
      free_ = std::exchange(sides_[free_], side).next;
    }
  }

  const HaloMesh& mesh_;
  std::vector<Side> sides_;
  std::int32_t free_ = none;             ///< first of the places whose side has both cells
  IdVector<NodeId, std::int32_t> last_;  ///< last side of each node
};

}  // namespace quadloop
