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

  /// By how much an owned node is to move; nothing where it is of no level line.
  Point move_of(NodeId node) const;

 private:
  struct Surroundings {
    std::uint64_t sum = 0;  ///< of numbers that stand for the shapes of the triangles around the node
    double edge = 0;        ///< of the smaller squares; nothing where all are of one size
  };
  void look_at(const std::array<NodeId, 3>& nodes);

  const HaloMesh& mesh_;
  const NodeFlags& near_;
  IdVector<NodeId, Surroundings> round_;
};

}  // namespace quadloop
