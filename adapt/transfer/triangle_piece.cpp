#include "adapt/transfer/triangle_piece.hpp"

#include "adapt/transfer/exchange_pieces.hpp"

namespace quadloop {

namespace {

template <class T>
using ForRanks = std::vector<std::vector<T>>;

ForRanks<CellTriangle> triangles_by_rank(const Communicator& comm, const CurveShares& shares,
                                         const Mesh& mesh, std::span<const CellTriangle> triangles) {
  ForRanks<CellTriangle> by_rank(static_cast<std::size_t>(comm.size()));
  std::vector<int> ranks;
  for (const CellTriangle& triangle : triangles) {
    Box box;
    for (const NodeId node : triangle.nodes) box.include(mesh.point(node));
    shares.ranks_meeting(box, ranks);
    for (const int rank : ranks) by_rank[static_cast<std::size_t>(rank)].push_back(triangle);
  }
  return by_rank;
}

/// Numbers the nodes of some triangles in the order in which they appear; the numbers that they had.
std::vector<NodeId> renumber(std::vector<CellTriangle>& triangles, std::vector<std::int32_t>& place_of) {
  std::vector<NodeId> nodes;
  for (CellTriangle& triangle : triangles) {
    for (NodeId& node : triangle.nodes) {
      std::int32_t& place = place_of[static_cast<std::size_t>(node.value())];
      if (place < 0) {
        place = static_cast<std::int32_t>(nodes.size());
        nodes.push_back(node);
      }
      node = NodeId{place};
    }
  }
  for (const NodeId node : nodes) place_of[static_cast<std::size_t>(node.value())] = -1;
  return nodes;
}

void append(TrianglePiece& piece, const std::vector<Point>& points, const std::vector<double>& values,
            const std::vector<CellTriangle>& triangles) {
  const auto before = static_cast<std::int32_t>(piece.points.size());
  piece.points.insert(piece.points.end(), points.begin(), points.end());
  piece.rows.values.insert(piece.rows.values.end(), values.begin(), values.end());
  for (CellTriangle triangle : triangles) {
    for (NodeId& node : triangle.nodes) node = NodeId{before + node.value()};
    piece.triangles.push_back(triangle);
  }
}

}  // namespace

TrianglePiece gather_piece(const Communicator& comm, const CurveShares& shares, const Mesh& mesh,
                           const NodeRows& rows, std::span<const CellTriangle> triangles) {
  ForRanks<CellTriangle> triangles_out = triangles_by_rank(comm, shares, mesh, triangles);
  ForRanks<Point> points_out(triangles_out.size());
  ForRanks<double> values_out(triangles_out.size());
  std::vector<std::int32_t> place_of(mesh.points.size(), -1);
  for (std::size_t rank = 0; rank < triangles_out.size(); ++rank) {
    for (const NodeId node : renumber(triangles_out[rank], place_of)) {
      points_out[rank].push_back(mesh.point(node));
      const auto row = rows.of(node);
      values_out[rank].insert(values_out[rank].end(), row.begin(), row.end());
    }
  }
  const auto all_triangles = exchange_pieces(comm, std::move(triangles_out));
  const auto all_points = exchange_pieces(comm, std::move(points_out));
  const auto all_values = exchange_pieces(comm, std::move(values_out));
  TrianglePiece piece;
  piece.rows.width = rows.width;
  for (std::size_t rank = 0; rank < all_triangles.size(); ++rank)
    append(piece, all_points[rank], all_values[rank], all_triangles[rank]);
  return piece;
}

}  // namespace quadloop
