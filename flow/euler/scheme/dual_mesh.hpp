#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "flow/euler/scheme/turned.hpp"
#include "mesher/base/id_vector.hpp"
#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/periodic_mesh.hpp"

namespace quadloop::flow::euler {

struct SkewFace;

/// An edge between two nodes with its face of the median dual.
struct DualEdge {
  NodeId low, high;  ///< local nodes, ordered by their global numbers
  Point normal;      ///< unit normal from the first to the second node
  /// Length of the face: of the vector sum of the two segments from the edge's midpoint to the centres of its
  /// cells.
  double size;
  Point half;  ///< from the first node to the edge's midpoint
};

/// Correction of an edge's dual face that is not symmetric about the edge's midpoint, next to quadrilaterals:
/// the integral over the face of position (relative to the midpoint) times normal. A linearly varying flux
/// contributes this times its gradient in addition to its value at the midpoint. In triangles these terms
/// cancel around each node; the correction is relative to that, so that the fluxes of a linear field sum
/// exactly on any mesh. It fades out for long thin cells on curved walls, where it would be unstable.
struct SkewEdge {
  std::size_t edge;      ///< index into the edges
  Point with_x, with_y;  ///< normals for the gradient along x and along y
};

/// A boundary edge with the domain to its left.
struct BoundaryFace {
  NodeId from, to;
  std::int32_t boundary;
  Point normal;      ///< unit normal out of the domain
  double half_size;  ///< half the face length, the part of each of its two nodes
  double blend;      ///< weight of the other node in a half: 1; less, down to 0, at thin cells
};

/// The median dual of a mesh around this rank's owned nodes: each node's part of a cell is bounded by the
/// midpoints of its two edges and the mean of the cell's nodes. Edges and boundary faces are ordered by the
/// global numbers of their nodes, so that sums over them are bitwise independent of the number of ranks. All
/// edges and faces that touch an owned node are present; for other nodes some may be missing.
class DualMesh {
 public:
  /// `mesh` must outlive the object unchanged. Throws InputError if an edge with a single cell is on no
  /// boundary. *Collective.*
  DualMesh(const Communicator& comm, const Mesh& mesh);
  /// The edges of a node continue across periodic pairs, to ghosts that are images. *Collective.*
  DualMesh(const Communicator& comm, const PeriodicMesh& joined);

  std::int64_t first_node() const { return first_node_; }  ///< as in the mesh
  std::int32_t owned_nodes() const { return halo_.owned_nodes(); }
  std::size_t nodes() const { return halo_.points().size(); }
  auto owned_ids() const { return ids_below(NodeId{owned_nodes()}); }
  auto ids() const { return ids_below(NodeId{size32(halo_.points())}); }
  bool is_owned(NodeId node) const { return halo_.owns(node); }
  Point point(NodeId node) const { return halo_.point(node); }
  GlobalNodeId global(NodeId node) const { return halo_.global(node); }
  const HaloMesh& halo() const { return halo_; }
  /// Whether the node is the image of another one, across periodic pairs.
  bool is_image(NodeId node) const { return shift_of(halo_.image(node)) != 0; }
  /// For values that do not depend on the directions of the axes; the others need update().
  const NodeExchange& exchange() const { return halo_.exchange(); }
  /// Updates the ghosts; images across a rotation get values that are turned, by turned(value, direction).
  /// *Collective.*
  template <class Values>
  void update(Values& values) const {
    exchange().update(values);
    for (const auto& [node, direction] : turned_) values[node] = turned(values[node], direction);
  }
  /// Updates only the ghosts of owned nodes for which `changed` is true. *Collective.*
  template <class Values, class Changed>
  void update(Values& values, const Changed& changed) const;

  const IdVector<NodeId, double>& areas() const { return areas_; }  ///< of the owned nodes' dual cells
  std::span<const DualEdge> edges() const { return edges_; }
  std::span<const SkewEdge> skew_edges() const { return skew_edges_; }
  std::span<const BoundaryFace> faces() const { return faces_; }

 private:
  struct TurnedImage {
    NodeId node;
    Point direction;  ///< cosine and sine
  };
  DualMesh(const Communicator& comm, HaloMesh halo, std::int64_t first_node, const PeriodicMaps* maps);
  void add_areas();
  void collect_edges();
  void collect_skew_edges(const std::vector<SkewFace>& faces);
  void collect_faces();

  HaloMesh halo_;
  std::vector<TurnedImage> turned_;
  std::int64_t first_node_;
  IdVector<NodeId, double> areas_;
  std::vector<DualEdge> edges_;
  std::vector<SkewEdge> skew_edges_;
  std::vector<char> open_;  ///< during construction, for each edge: 1 if it has one cell and no boundary yet
  std::vector<BoundaryFace> faces_;
};

template <class Values, class Changed>
void DualMesh::update(Values& values, const Changed& changed) const {
  if (turned_.empty()) return exchange().update(values, changed);
  IdVector<NodeId, char> is_new(nodes(), 0);
  for (const NodeId node : owned_ids()) is_new[node] = changed(node.value()) ? 1 : 0;
  exchange().update(is_new);
  exchange().update(values, changed);
  for (const auto& [node, direction] : turned_) {
    if (is_new[node] != 0) values[node] = turned(values[node], direction);
  }
}

}  // namespace quadloop::flow::euler
