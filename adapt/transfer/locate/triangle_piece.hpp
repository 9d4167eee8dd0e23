#pragma once

#include <span>
#include <vector>

#include "adapt/transfer/locate/cell_triangles.hpp"
#include "adapt/transfer/locate/curve_partition.hpp"
#include "mesher/mesh/field.hpp"

namespace quadloop::adapt {

/// Triangles from any ranks, with their own node numbering.
struct TrianglePiece {
  IdVector<NodeId, Point> points;
  Field field;
  std::vector<CellTriangle> triangles;

  std::array<Point, 3> corners(const CellTriangle& triangle) const {
    const auto at = [&](std::size_t k) { return points[triangle.nodes[k]]; };
    return {at(0), at(1), at(2)};
  }
};

/// The triangles of all ranks that meet this rank's part of the plane, with the values at their nodes.
/// *Collective.*
TrianglePiece gather_piece(const Communicator& comm, const CurvePartition& shares, const Mesh& mesh,
                           const Field& field, std::span<const CellTriangle> triangles);

}  // namespace quadloop::adapt
