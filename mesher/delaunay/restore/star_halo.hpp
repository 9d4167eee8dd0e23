#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "mesher/delaunay/flipper.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/mesh/node_exchange.hpp"

namespace quadloop {

/// The triangles of a region around the nodes that this rank owns, then those around their nodes, ring by
/// ring. The region is the union over all ranks. Owners of nodes know all triangles around them, on whatever
/// rank, so that any distribution of the mesh is allowed. Nodes have the mesh's local numbers; nodes that the
/// mesh lacks have further numbers.
class StarHalo {
 public:
  using Triangle = Flipper::Triangle;

  /// Data of a mesh's triangles and nodes; each array has an entry for all of them or is empty.
  struct Known {
    const std::vector<std::int32_t>& triangle_to_block;
    const NodeFlags& moved;  ///< moved since the mesh was Delaunay; owned nodes and ghost copies
  };
  /// An edge by its nodes.
  using GlobalEdge = std::array<GlobalNodeId, 2>;
  /// The region is the triangles around the nodes flagged in `core` (owned nodes and ghost copies). Mesh,
  /// owners and `known` must outlive the halo. `of_lines`: the edges of inner lines on all ranks.
  /// *Collective.*
  StarHalo(const Communicator& comm, const NodeOwners& owners, const Mesh& mesh, const NodeFlags& core,
           const Known& known, const std::vector<GlobalEdge>& of_lines);
  StarHalo(const StarHalo&) = delete;
  StarHalo& operator=(const StarHalo&) = delete;

  /// Fetches the triangles around all present nodes, on ranks with `wanted`. *Collective.*
  void grow(bool wanted);

  /// Those around owned nodes first.
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Global number of a triangle.
  std::int64_t number(std::size_t triangle) const { return numbers_[triangle]; }
  /// A block for each triangle, or empty.
  const std::vector<std::int32_t>& blocks() const { return blocks_; }
  /// Whether triangles of the region across one of its edges may be missing.
  bool at_rim(std::size_t triangle) const;
  /// Whether the triangles around all present nodes are complete.
  bool complete() const { return frontier_.empty(); }

  std::span<const Point> points() const { return points_; }
  bool owns(std::int32_t node) const { return owns(global(node)); }
  GlobalNodeId global(std::int32_t node) const { return nodes_[node]; }
  /// Whether the region contains all triangles around the node.
  bool is_core(std::int32_t node) const { return core_[node] != 0; }
  /// A flag for each node; empty if all may have moved.
  std::span<const char> moved() const { return moved_; }
  /// The edges of inner lines between nodes of the region, which are not flipped; as in Flipper.
  std::vector<Flipper::Ends> kept_edges() const;

 private:
  /// A triangle in a message, with the data of its nodes.
  struct Travelling {
    std::int64_t number = 0;
    std::array<GlobalNodeId, 3> nodes;
    std::array<Point, 3> points;
    std::int32_t block = 0;
    std::array<char, 3> core{}, moved{};
  };
  enum class Star : char { unknown, missing, here };  ///< state of the triangles around a node

  bool owns(GlobalNodeId node) const {
    const std::int64_t offset = node.value() - mesh_.first_node;
    return 0 <= offset && offset < mesh_.owned_nodes;
  }
  void gather_stars(const NodeFlags& core);
  /// Number of one of the mesh's nodes; fast for those that already have one.
  std::int32_t number_node(NodeId node, const NodeFlags& core) {
    if (mesh_.owns(node) && number_of_owned_[node.value()] >= 0) return number_of_owned_[node.value()];
    return number_node(mesh_.global(node), mesh_.point(node), core[node],
                       known_.moved.empty() ? 1 : known_.moved[node]);
  }
  std::int32_t number_node(GlobalNodeId node, Point point, char core, char moved);
  void share(const Triangle& nodes, std::int64_t number, std::int32_t block, Outbox<Travelling>& to_owners);
  void add(const Triangle& nodes, std::int64_t number, std::int32_t block);
  void add(const Travelling& triangle);
  Travelling travelling(const Triangle& nodes, std::int64_t number, std::int32_t block) const;
  void answer(int rank, std::span<const GlobalNodeId> nodes, Outbox<Travelling>& answers) const;
  bool has_owned(const Triangle& t) const { return owns(t[0]) || owns(t[1]) || owns(t[2]); }
  bool is_known(std::int32_t node) const { return stars_[node] == Star::here; }

  const Communicator& comm_;
  const NodeOwners& owners_;
  const Mesh& mesh_;
  const Known known_;
  const std::vector<GlobalEdge>& of_lines_;
  std::vector<std::int32_t> number_of_owned_;  ///< for each owned node its number here, if present
  std::unordered_map<GlobalNodeId, std::int32_t> number_of_other_;
  std::vector<GlobalNodeId> nodes_;  ///< nodes present
  std::vector<Point> points_;
  std::vector<char> core_, moved_;
  std::vector<Star> stars_;
  std::vector<Triangle> triangles_;
  std::vector<std::int64_t> numbers_;
  std::vector<std::int32_t> blocks_;
  std::vector<std::int32_t> frontier_;        ///< nodes of other ranks whose triangles are not here
  std::unordered_set<std::int64_t> fetched_;  ///< triangles without owned nodes, by number
};

}  // namespace quadloop
