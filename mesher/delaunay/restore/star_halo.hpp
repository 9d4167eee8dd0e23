#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <unordered_set>
#include <vector>

#include "mesher/geometry/point.hpp"
#include "mesher/mesh/node_exchange.hpp"

namespace quadloop {

/// A triangle by its number over all ranks, with its nodes by theirs.
struct NumberedTriangle {
  std::int64_t number = 0;
  std::array<GlobalNodeId, 3> nodes;
  std::array<Point, 3> points;
  std::int32_t block = 0;
  std::array<char, 3> core{};  ///< a flag for each node: no triangle around it is missing from the region
  std::array<char, 3> moved{1, 1, 1};  ///< 0 for a node around which all were Delaunay, and which has stayed
};

/// The triangles of a region, which all ranks hold together, around the nodes that this rank owns; then those
/// around their nodes, ring by ring. Owners of nodes know all triangles around them, wherever these are kept,
/// so that it works on any distributed mesh.
class StarHalo {
 public:
  /// `own` are the triangles of the region that this rank keeps; `owners` must outlive the halo.
  /// *Collective.*
  StarHalo(const Communicator& comm, const NodeOwners& owners, std::vector<NumberedTriangle> own);

  /// Fetches the triangles around all nodes of those at hand, on ranks that want it. *Collective.*
  void grow(bool wanted);

  /// Those around owned nodes first.
  std::span<const NumberedTriangle> triangles() const { return triangles_; }
  /// Whether triangles of the region beyond one of its edges may not have been fetched.
  bool at_rim(const NumberedTriangle& triangle) const;
  /// Whether no triangle around any node at hand is missing.
  bool complete() const { return frontier_.empty(); }

  /// Of an owned node.
  NodeId local(GlobalNodeId node) const { return owners_.local(node); }
  bool owns(GlobalNodeId node) const { return owners_.rank_of(node) == comm_.rank(); }

 private:
  /// A triangle around an owned node.
  struct Spoke {
    GlobalNodeId node;
    std::size_t triangle = 0;
    friend auto operator<=>(const Spoke&, const Spoke&) = default;
  };
  bool known(GlobalNodeId node) const { return owns(node) || fetched_.contains(node); }
  void gather_stars(std::span<const NumberedTriangle> own);
  void list_spokes();
  void add(const NumberedTriangle& triangle);
  std::vector<NumberedTriangle> around(std::span<const GlobalNodeId> nodes) const;

  const Communicator& comm_;
  const NodeOwners& owners_;
  std::vector<NumberedTriangle> triangles_;
  std::vector<Spoke> spokes_;                  ///< sorted; none on a rank that is alone
  std::unordered_set<std::int64_t> numbers_;   ///< of the triangles at hand
  std::unordered_set<GlobalNodeId> fetched_;   ///< other ranks' nodes around which all triangles are at hand
  std::unordered_set<GlobalNodeId> frontier_;  ///< other nodes of the triangles at hand
};

}  // namespace quadloop
