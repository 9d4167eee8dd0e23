#pragma once

#include <array>
#include <cstdint>

#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop::smoother {

/// Finds, in a mesh of triangles, the nodes near lines where halved squares of two sizes meet. A node is
/// recognised by the triangles around it.
class TriangleLines {
 public:
  /// Examines owned nodes that are flagged `near`. Both arguments must outlive it.
  TriangleLines(const HaloMesh& mesh, const NodeFlags& near);

  /// Calls `visit(node, move)` for each owned node to be moved.
  template <class Visit>
  void for_each_move(const Visit& visit) const {
    for_each_flagged(near_, [&](NodeId node) {
      if (mesh_.owns(node) && round_[node].edge > 0) visit(node, move_of(node));
    });
  }

 private:
  struct Surroundings {
    std::uint64_t sum = 0;  ///< sum of the numbers of the shapes of the triangles around the node
    double edge = 0;        ///< edge length of the smaller squares; 0 where all squares have one size
  };
  void look_at(const std::array<NodeId, 3>& nodes);
  Point move_of(NodeId node) const;

  const HaloMesh& mesh_;
  const NodeFlags& near_;
  IdVector<NodeId, Surroundings> round_;
};

}  // namespace quadloop::smoother
