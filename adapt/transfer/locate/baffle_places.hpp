#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "adapt/transfer/locate/nearest_boundary.hpp"
#include "mesher/base/parallel/communicator.hpp"
#include "mesher/geometry/box_tree.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// The baffles of a mesh, on every rank: pairs of boundary edges at the same place in opposite directions,
/// each with the domain to its left. Their order does not depend on the ranks.
class Baffles {
 public:
  struct Edge {
    Point from, to;
    GlobalNodeId from_node, to_node;
    std::int32_t rank = 0, index = 0;             ///< as in BoundaryPlace
    bool tip_at_from = false, tip_at_to = false;  ///< whether the baffle has a free end there

    Point direction() const { return (1 / length(to - from)) * (to - from); }
  };

  /// *Collective.*
  Baffles(const Communicator& comm, const Mesh& mesh);

  const std::vector<Edge>& edges() const { return edges_; }
  /// Returns the edge with the largest `share(edge)` among those at the smallest distance from a point, up to
  /// rounding, or null. Edges with a negative share do not count.
  template <class Share>
  const Edge* nearest(Point p, const Share& share) const;

 private:
  std::vector<Edge> edges_;
  BoxTree tree_;
};

/// Where a new mesh takes values from the boundary of an old one, so that none crosses a baffle: at nodes on
/// baffles, and between two chords of a bent baffle, one of each mesh.
class BafflePlaces {
 public:
  /// *Collective.*
  BafflePlaces(const Communicator& comm, const Mesh& old_mesh, const Mesh& new_mesh);

  bool none() const { return old_.edges().empty() || new_.edges().empty(); }
  /// The place on the old mesh's boundary of a new mesh's node on a baffle, on the node's own side.
  std::optional<BoundaryPlace> of_node(GlobalNodeId node) const;
  /// The place for a point of the new mesh that the old mesh has on the other side of a baffle, if it has.
  std::optional<BoundaryPlace> across(Point p) const;

 private:
  const Baffles::Edge* old_edge_along(const Baffles::Edge& edge, Point at) const;

  Baffles old_, new_;
  /// The edges that start at the new mesh's nodes, and those that end there, ascending.
  std::vector<std::pair<GlobalNodeId, std::int32_t>> starts_, ends_;
};

}  // namespace quadloop::adapt
