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

/// The triangles of a region, which all ranks hold together, around the nodes that this rank owns; then those
/// around their nodes, ring by ring. Owners of nodes know all triangles around them, wherever these are kept,
/// so that it works on any distributed mesh. Nodes go by the mesh's numbers on this rank, those that it lacks
/// by further ones.
class StarHalo {
 public:
  using Triangle = Flipper::Triangle;

  /// What is known of a mesh's triangles and nodes, each for all of them or for none.
  struct Known {
    const std::vector<std::int32_t>& triangle_to_block;
    const NodeFlags& moved;  ///< since the mesh was Delaunay; owned nodes and copies
  };
  /// The region is the triangles around `core` nodes; owned nodes and copies are flagged. Mesh, owners and
  /// what is known must outlive the halo. *Collective.*
  StarHalo(const Communicator& comm, const NodeOwners& owners, const Mesh& mesh, const NodeFlags& core,
           const Known& known);
  StarHalo(const StarHalo&) = delete;
  StarHalo& operator=(const StarHalo&) = delete;

  /// Fetches the triangles around all nodes of those at hand, on ranks that want it. *Collective.*
  void grow(bool wanted);

  /// Those around owned nodes first.
  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Of a triangle over all ranks.
  std::int64_t number(std::size_t triangle) const { return numbers_[triangle]; }
  /// A block for each triangle, or none.
  const std::vector<std::int32_t>& blocks() const { return blocks_; }
  /// Whether triangles of the region beyond one of its edges may not have been fetched.
  bool at_rim(std::size_t triangle) const;
  /// Whether no triangle around any node at hand is missing.
  bool complete() const { return frontier_.empty(); }

  std::span<const Point> points() const { return points_; }
  bool owns(std::int32_t node) const { return owns(global(node)); }
  GlobalNodeId global(std::int32_t node) const { return nodes_[node]; }
  /// Whether no triangle around the node is missing from the region.
  bool is_core(std::int32_t node) const { return core_[node] != 0; }
  /// A flag for each node, or none where all may have moved.
  std::span<const char> moved() const { return moved_; }

 private:
  /// A triangle on its way, with what is known of its nodes.
  struct Travelling {
    std::int64_t number = 0;
    std::array<GlobalNodeId, 3> nodes;
    std::array<Point, 3> points;
    std::int32_t block = 0;
    std::array<char, 3> core{}, moved{};
  };
  enum class Star : char { unknown, missing, here };  ///< the triangles around a node

  bool owns(GlobalNodeId node) const {
    const std::int64_t offset = node.value() - mesh_.first_node;
    return 0 <= offset && offset < mesh_.owned_nodes;
  }
  void gather_stars(const NodeFlags& core);
  /// Of one of the mesh's nodes, most of which have their number.
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
  std::vector<std::int32_t> number_of_owned_;  ///< of each owned node its number here, if it is at hand
  std::unordered_map<GlobalNodeId, std::int32_t> number_of_other_;
  std::vector<GlobalNodeId> nodes_;  ///< those at hand
  std::vector<Point> points_;
  std::vector<char> core_, moved_;
  std::vector<Star> stars_;
  std::vector<Triangle> triangles_;
  std::vector<std::int64_t> numbers_;
  std::vector<std::int32_t> blocks_;
  std::vector<std::int32_t> frontier_;        ///< nodes of others whose triangles are not here
  std::unordered_set<std::int64_t> fetched_;  ///< triangles without owned nodes, by their numbers
};

}  // namespace quadloop
