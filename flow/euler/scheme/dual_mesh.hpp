#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop::euler {

struct SkewFace;

/// An edge between two nodes and the face of the median dual that it crosses.
struct DualEdge {
  std::int32_t low, high;  ///< nodes of this rank; the first has the lower number over all ranks
  Point normal;            ///< of length 1, from the first to the second
  double size;  ///< the face's length: the two segments from the edge's middle to the centres of its cells,
                ///< as a vector
  Point half;   ///< from the first node to the edge's middle
};

/// What an edge's dual face lacks of symmetry about the edge's middle, where cells beside it are
/// quadrilaterals: the integral over the face of place (from the middle) times normal. A flux that varies
/// linearly carries that times its gradient beside its value in the middle. In triangles these terms cancel
/// round each node; what is here counts from that, so that the fluxes of a linear field add up exactly on any
/// mesh, but for long thin cells on curved walls: there it fades, since it would make the scheme unstable.
struct SkewEdge {
  std::size_t edge;      ///< into the edges
  Point with_x, with_y;  ///< normals that go with the gradient along x and along y
};

/// A boundary edge, the domain to its left.
struct BoundaryFace {
  std::int32_t from, to;
  std::int32_t boundary;
  Point normal;      ///< of length 1, out of the domain
  double half_size;  ///< each of its two nodes has one half of it
  double blend;      ///< 1; less at thin cells, to 0: how much of the other node counts in a half
};

/// The median dual of a mesh around this rank's owned nodes: each node's part of a cell is bounded by the
/// middles of its two edges and the mean of the cell's nodes. Edges and boundary faces come in the order of
/// their nodes' numbers over all ranks, so that what a node adds up over them has the same bits on any number
/// of ranks. Every edge and face that touches an owned node is there; nodes that are not owned may lack some.
class DualMesh {
 public:
  /// `mesh` must outlive it and stay as it is. Throws InputError where an edge of one cell alone is on no
  /// boundary. *Collective.*
  DualMesh(const Communicator& comm, const Mesh& mesh);

  std::int64_t first_node() const { return first_node_; }  ///< as of the mesh
  std::int32_t owned_nodes() const { return halo_.owned_nodes(); }
  std::size_t nodes() const { return halo_.points().size(); }
  bool is_owned(std::int32_t node) const { return node < owned_nodes(); }
  Point point(std::int32_t node) const { return halo_.point(NodeId{node}); }
  GlobalNodeId global(std::int32_t node) const { return halo_.global(NodeId{node}); }
  const HaloMesh& halo() const { return halo_; }
  const NodeExchange& exchange() const { return halo_.exchange(); }

  std::span<const double> areas() const { return areas_; }  ///< of the owned nodes' dual cells
  std::span<const DualEdge> edges() const { return edges_; }
  std::span<const SkewEdge> skew_edges() const { return skew_edges_; }
  std::span<const BoundaryFace> faces() const { return faces_; }

 private:
  void add_areas();
  void collect_edges();
  void collect_skew_edges(const std::vector<SkewFace>& faces);
  void collect_faces();

  HaloMesh halo_;
  std::int64_t first_node_;
  IdVector<NodeId, double> areas_;
  std::vector<DualEdge> edges_;
  std::vector<SkewEdge> skew_edges_;
  std::vector<char> open_;  ///< while it is built, for each edge: 1 where it has one cell and no boundary yet
  std::vector<BoundaryFace> faces_;
};

}  // namespace quadloop::euler
