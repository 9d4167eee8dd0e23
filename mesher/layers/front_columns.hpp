#pragma once

#include <array>
#include <vector>

#include "mesher/layers/fans.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/node_exchange.hpp"

namespace quadloop {

/// A node of the mesh with layers.
struct LayerNode {
  GlobalNodeId id;
  Point point;
};

/// The columns on the front's nodes, and the numbers of all nodes of the mesh with layers: those outside keep
/// their order, a column's nodes follow its front node, from the wall on. The lowest nodes of a fan's columns
/// may belong to others: the edge itself to the first one, and rows merge.
class FrontColumns {
 public:
  /// All that is given must outlive it. *Collective.*
  FrontColumns(const Communicator& comm, const LayerFront& front, const Mesh& outside);

  /// Whether layers stand on a boundary edge of the mesh outside.
  bool is_front(const std::array<NodeId, 2>& edge) const {
    return places_on_.follows(place_[edge[0]], place_[edge[1]]);
  }
  /// Where a node of a front edge, or an own node, lies on the front; invalid elsewhere.
  const FrontPlace& place(NodeId node) const { return place_[node]; }
  /// The fan in which the node stands, or WallLine::none.
  std::int32_t fan_of(NodeId node) const { return fans_.fan_of(place_[node]); }

  /// All nodes of a column from the wall to the front, of a node that has a place there; those below its
  /// lowest ring have no number.
  const std::vector<LayerNode>& column(NodeId node) const { return columns_[node]; }
  /// The corners of the cells that begin at a fan's node, before the next one; on any rank with such an edge.
  std::vector<std::vector<LayerNode>> cells_of_sector(NodeId node) const;
  /// The places of the nodes that are numbered with an own node: itself, and its column from its lowest ring
  /// on.
  std::vector<Point> numbered_with(NodeId node) const;

  GlobalNodeId numbered(NodeId node) const { return numbered_[node]; }
  std::int64_t first_node() const { return first_node_; }
  std::int32_t owned_nodes() const { return owned_nodes_; }
  bool owns(GlobalNodeId id) const {
    return first_node_ <= id.value() && id.value() < first_node_ + owned_nodes_;
  }
  const WallLine& line() const { return front_.line; }

 private:
  void find_places();
  void gather_rays();
  void number_nodes();
  void make_columns();
  Ray ray_at(NodeId node) const;
  int lowest_ring(const Ray& ray) const;
  std::vector<LayerNode> column_on(const Ray& ray) const;
  LayerNode apex(std::int32_t fan) const;

  const Communicator& comm_;
  const LayerFront& front_;
  const Mesh& outside_;
  FrontPlaces places_on_;
  Fans fans_;
  NodeOwners owners_;
  IdVector<NodeId, FrontPlace> place_;
  IdVector<NodeId, GlobalNodeId> numbered_;
  IdVector<NodeId, std::vector<LayerNode>> columns_;
  std::int64_t first_node_ = 0;
  std::int32_t owned_nodes_ = 0;
};

}  // namespace quadloop
