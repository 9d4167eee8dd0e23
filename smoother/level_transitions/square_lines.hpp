#pragma once

#include <array>

#include "mesher/mesh/halo_mesh.hpp"

namespace quadloop::smoother {

/// Finds the owned nodes on lines where squares of two sizes meet: the cells of such a node are two equal
/// squares on one side of the line and triangles of a division at hanging nodes on the other.
class SquareLines {
 public:
  explicit SquareLines(const HaloMesh& mesh);

  /// Calls `visit(node, move)` for each owned node to be moved.
  template <class Visit>
  void for_each_move(const Visit& visit) const {
    for (const NodeId node : round_.ids()) {
      if (round_[node].line_ends == 0b11) visit(node, move_of(node));
    }
  }

 private:
  /// The cells around a node. Bit k of `quadrants` stands for a square in quadrant k (0: right and up, then
  /// counter-clockwise).
  struct Surroundings {
    double edge = 0;  ///< edge length of the squares
    unsigned quadrants = 0;
    unsigned line_ends = 0;  ///< bit 0, 1: triangles reach the node's neighbour on the line, on either side
  };

  Point move_of(NodeId node) const;
  void exclude(NodeId node);
  void look_at_squares(const std::array<NodeId, 4>& nodes);
  void look_at_squares(const std::array<NodeId, 3>&) {}
  void look_at_triangles(const std::array<NodeId, 3>& nodes);
  void look_at_triangles(const std::array<NodeId, 4>&) {}

  const HaloMesh& mesh_;
  IdVector<NodeId, Surroundings> round_;
};

}  // namespace quadloop::smoother
