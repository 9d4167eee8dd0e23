#pragma once

#include <array>
#include <cstdint>

#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop {

/// Finds the nodes near lines where halved squares of two sizes meet, by the triangles around each, in a mesh
/// of triangles.
class TriangleLines {
 public:
  /// Looks at owned nodes that are flagged `near`. Both must outlive it.
  TriangleLines(const HaloMesh& mesh, const NodeFlags& near);

  /// Calls `visit(node, move)` for owned nodes that are to move.
  template <class Visit>
  void for_each_move(const Visit& visit) const {
    for_each_flagged(near_, [&](NodeId node) {
      if (mesh_.owns(node) && round_[node].edge > 0) visit(node, move_of(node));
    });
  }

 private:
  struct Surroundings {
    std::uint64_t sum = 0;  ///< of numbers that stand for the shapes of the triangles around the node
    double edge = 0;        ///< of the smaller squares; nothing where all are of one size
  };
  void look_at(const std::array<NodeId, 3>& nodes);
  Point move_of(NodeId node) const;

  const HaloMesh& mesh_;
  const NodeFlags& near_;
  IdVector<NodeId, Surroundings> round_;
};

}  // namespace quadloop
